// Keys; those that a control of the page uses itself are left to it.
import {kViewNames} from './stage.js';

export const kKeys = [
  ['space', 'play or pause'],
  ['← →', 'a little back or on'],
  ['[ ]', 'push before, next push'],
  ['home end', 'to the beginning, to the end'],
  ['− +', 'slower, faster'],
  ['f', 'hand or world stands still'],
  ['1 2 3', 'view: free, from the front, from the side'],
  ['d', 'dark or light'],
  ['?', 'these keys'],
];

export function listen(viewer) {
  const {transport, theme} = viewer;
  const little = () => Math.max(transport.duration / 200, 1e-3);
  const actions = {
    ' ': () => transport.toggle(),
    ArrowLeft: () => transport.seek(transport.time - little()),
    ArrowRight: () => transport.seek(transport.time + little()),
    '[': () => transport.step(-1),
    ']': () => transport.step(1),
    Home: () => transport.seek(0),
    End: () => transport.seek(transport.duration),
    '-': () => transport.faster(-1),
    '+': () => transport.faster(1),
    f: () => viewer.setWorld(!viewer.isWorld),
    ...Object.fromEntries(kViewNames.map((view, i) => [i + 1, () => viewer.look(view)])),
    d: () => theme.toggle(),
    '?': () => viewer.help.toggleAttribute('open'),
  };
  window.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const isControl = event.target.closest?.('select, input, button, summary, a');
    if (isControl && (event.key === ' ' || event.key.startsWith('Arrow') || event.key === 'Home' || event.key === 'End')) return;
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
