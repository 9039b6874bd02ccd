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

/// Without the sign of what rounds to zero.
const fixed = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, '');

export const mm = (metres) => `${fixed(1e3 * metres, 2)} mm`;
export const deg = (radians) => `${fixed((180 / Math.PI) * radians, 1)}°`;
export const newton = (force) => (force === null ? 'none' : `${fixed(force, 2)} N`);
