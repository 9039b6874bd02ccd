// What is known in words and numbers: the verdict, the pushes, the moment that is shown.
import {deg, element, mm, newton} from './elements.js';

const kPhases = {
  transit: 'moves to the next pusher',
  approach: 'approaches',
  grip: 'changes its grip',
  retreat: 'retreats',
};

function poseText([x, y, theta, psi]) {
  const roll = psi ? `, roll ${deg(psi)}` : '';
  return `x ${mm(x)}, y ${mm(y)}, ${deg(theta)}${roll}`;
}

/// A direction in the hand, by the axes that it has at least 22.5 deg of.
function towards(v) {
  const length = Math.hypot(...v);
  return v.map((part, i) => (Math.abs(part) > 0.38 * length ? `${part < 0 ? '−' : '+'}${'xyz'[i]}` : ''))
    .filter((axis) => axis).join(' ');
}

/// What a point of contact with the pusher does: it sticks, or the object slips on the pusher.
function contactText({mode, force, n, slip}) {
  if (mode === 'open') return 'apart';
  const normal = newton(force.reduce((sum, f, i) => sum + f * n[i], 0));
  if (mode === 'stick') return `sticks, normal force ${normal}`;
  const way = slip.some((part) => part !== 0) ? ` towards ${towards(slip)} of the hand` : '';
  return `the object slips along the pusher${way}, normal force ${normal}`;
}

function facts(rows) {
  const cells = rows.flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]);
  return element('dl', {}, ...cells);
}

/// Whether there is a plan, and if not, why.
export function verdictBox({verdict, is_plan, pushes}) {
  if (!is_plan) {
    const push = pushes[0];
    if (!push) return element('p', {class: 'verdict'}, 'The scene at its start; nothing is pushed.');
    const good = push.completed;
    return element('div', {class: `verdict ${good ? 'good' : 'bad'}`, role: 'status'},
      element('b', {}, good ? 'The push completes' : `The push ends early: ${push.status}`),
      good ? null : element('p', {}, push.reason || `after ${(100 * push.done).toFixed(1)} %`));
  }
  if (!verdict.usable) {
    return element('div', {class: 'verdict bad', role: 'alert'},
      element('b', {}, `No plan: ${verdict.status}`),
      element('p', {}, verdict.proof || verdict.message),
      verdict.explanation ? element('p', {}, verdict.explanation) : null,
      verdict.changes.length === 0 ? null : element('ul', {}, ...verdict.changes.map(({what, option}) =>
        element('li', {}, what, option ? element('code', {}, option) : null))));
  }
  if (!verdict.agrees) {
    return element('div', {class: 'verdict bad', role: 'alert'},
      element('b', {}, 'A replay does not agree with this plan'), element('p', {}, verdict.why));
  }
  return element('div', {class: 'verdict good', role: 'status'},
    element('b', {}, pushes.length === 0 ? 'Nothing to do: the start is a goal' : 'A replay with the exact mechanics agrees'),
    facts([
      ['pushes', String(pushes.length + verdict.left_out) + (verdict.left_out ? `, the first ${pushes.length} of them shown` : '')],
      ['placements', String(verdict.placements ?? 0)],
      ['cost', verdict.cost === null ? '0' : verdict.cost.toFixed(3)],
      ['lower bound', verdict.lower_bound === null ? 'none' : verdict.lower_bound.toFixed(3)],
      ['survives', verdict.promise],
    ]));
}

function pushText(push, pushers) {
  const grip = push.grip_force === undefined ? '' : `, grip ${newton(push.grip_force)}`;
  return `${push.kind} by ${pushers[push.pusher].name} on ${push.face}${grip}`;
}

export class PushList {
  constructor(film, onPush) {
    const {pushes, pushers} = film.data;
    this.buttons = pushes.map((push, i) => element('button', {onclick: () => onPush(i)},
      `${i + 1}. ${pushText(push, pushers)}`, push.completed ? null : element('em', {}, ` ${push.status}`)));
    this.root = element('ol', {class: 'pushes', 'aria-label': 'Pushes'}, ...this.buttons.map((button) => element('li', {}, button)));
  }

  show(index) {
    this.buttons.forEach((button, i) => {
      if (i === index) button.setAttribute('aria-current', 'step');
      else button.removeAttribute('aria-current');
    });
  }
}

export class Moment {
  constructor(film) {
    this.film = film;
    this.root = element('div', {class: 'moment', 'aria-live': 'off'});
  }

  show({phase, push, frame, X_HO}) {
    const {pushers, pushes} = this.film.data;
    const rows = [['object in hand', poseText(X_HO)]];
    let title = 'Start';
    if (phase) {
      const number = `Push ${phase.push + 1} of ${pushes.length}`;
      title = phase.kind === 'push' ? `${number}: ${pushText(push, pushers)}` : `${number}: the hand ${kPhases[phase.kind]}`;
    }
    if (frame) {
      rows.push(['push force', newton(frame.push_force)]);
      frame.pusher.forEach((load, i) => rows.push([`contact ${i + 1}`, contactText(load)]));
      if (frame.slack !== null) rows.push(['slack', frame.slack.toFixed(4)]);
      rows.push(['instant', `${frame.status}${push.in_space ? ', in space' : ''}`]);
      if (frame.certificate !== null) rows.push(['certificate', frame.certificate.toExponential(1)]);
    }
    this.root.replaceChildren(element('h2', {}, title), facts(rows));
  }
}
