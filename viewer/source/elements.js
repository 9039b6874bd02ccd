// Elements made by hand: all text goes in as text, never as markup.

export function element(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

export function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function filled(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (key === 'onclick') node.addEventListener('click', value);
    else if (value !== false && value !== null) node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children.filter((child) => child !== null));
  return node;
}

export const mm = (metres) => `${(1e3 * metres).toFixed(2)} mm`;
export const deg = (radians) => `${((180 / Math.PI) * radians).toFixed(1)}°`;
export const newton = (force) => (force === null ? 'none' : `${force.toFixed(2)} N`);
