// Keyboard of the lab: all that a mouse can do.
import { clockKeys, key, type Key, viewKeys } from '../ui/keys';
import type { Page } from './lab';

export function labKeys(page: Page): Key[] {
  return [...runKeys(page), ...inputKeys(page), ...viewAndSelectionKeys(page), ...pageKeys(page)];
}

function runKeys(page: Page): Key[] {
  const { time } = page.set;
  const step = () => {
    if (!page.isTab('Inspector')) page.send({ do: 'step', steps: 1 }); // else a step of the call
  };
  return [
    ...clockKeys(time),
    key('.', 'one step of the run (in the inspector: next step of the call; , previous)', step),
    key('End', 'to the newest instant', () => time.seek(Infinity)),
    key('b', 'branch from this instant', () => time.openBranch()),
  ];
}

const SPRING = 'apply a spring force to the selected body with the arrow keys; x releases';

// Arrow keys move the end effector, joint or spring if one is chosen, else they seek.
function inputKeys(page: Page): Key[] {
  const { operator, keys, set: { time } } = page;
  const move = (right: number, up: number, away: number) => (event: KeyboardEvent) => {
    if (keys.isOn) keys.move(right, up, away, event.shiftKey);
    else if (right !== 0) time.seekBy(right, event.shiftKey);
  };
  return [
    key('h', 'move the end effector with the arrow keys, page up, page down', () => keys.focusTip()),
    key('j', 'move the next joint with the arrow keys', () => keys.nextJoint()),
    key('x', SPRING, () => keys.toggleSpring(page.selected)),
    key('← →', 'otherwise: seek; with shift by 0.5 s', {
      ArrowLeft: move(-1, 0, 0),
      ArrowRight: move(1, 0, 0),
      ArrowUp: move(0, 1, 0),
      ArrowDown: move(0, -1, 0),
      PageUp: move(0, 0, 1),
      PageDown: move(0, 0, -1),
    }),
    key('g', 'gripper', () => {
      const closed = !operator.isGripperClosed;
      if (operator.button(0, closed)) page.showMessage(`Gripper ${closed ? 'closed' : 'open'}.`);
    }),
    key('c', 'clutch', () => {
      const pressed = !operator.clutch;
      if (operator.button(1, pressed)) page.showMessage(`Clutch ${pressed ? 'pressed' : 'released'}.`);
    }),
  ];
}

function viewAndSelectionKeys(page: Page): Key[] {
  const { live, overlays, views } = page;
  const selectNext = (by: number) => () => {
    const { scene } = page;
    if (!scene) return;
    const moving = scene.bodies.flatMap(({ moves }, i) => (moves ? [i] : []));
    const at = page.selected === null ? -1 : moving.indexOf(page.selected);
    page.select(moving[(at + by + moving.length) % moving.length] ?? null);
  };
  return [
    key('m', 'select the next body; with shift the previous one', { m: selectNext(1), M: selectNext(-1) }),
    ...viewKeys({
      orbit: (...by) => live.stage?.orbit(...by),
      look: (name) => page.look(name),
      followNext: () => views.next(page.selected),
      overlays,
      toggleTheme: () => page.toggleTheme(),
    }),
  ];
}

function pageKeys(page: Page): Key[] {
  const { keys, overlays, set: { gallery } } = page;
  const tab = (title: string) => () => page.showTab(title);
  const tabs = { n: tab('Parameters'), p: tab('Plots'), i: tab('Inspector'), l: tab('Energy') };
  const leave = () => {
    if (!overlays.folded) overlays.fold(true);
    else if (keys.isOn) keys.leave();
    else page.select(null);
  };
  return [
    key('n p i l', 'parameters, plots, inspector, energy', tabs),
    key('\\', 'hide or show the panel', () => page.togglePanel()),
    key('e', 'scenes', () => gallery.root.showModal()),
    key('Esc', 'end keyboard input, deselect', { Escape: leave }),
  ];
}

// Keys that the focused slider, tab or dialog handles.
export function isKept(event: KeyboardEvent): boolean {
  const at = event.target;
  if (!(at instanceof Element)) return false;
  if (at.closest('dialog[open]') || document.querySelector('dialog:modal')) return true;
  const moves = /^(Arrow|Page|Home|End)/.test(event.key);
  if (at instanceof HTMLInputElement && at.type === 'range') return moves;
  if (at.closest('[role=radiogroup], [role=tablist], [role=slider], details[open]'))
    return moves || event.key === 'Escape';
  return at.closest('summary') !== null && (event.key === ' ' || event.key === 'Enter');
}

export const MOUSE =
  'Mouse: drag the ring to move the end effector, a link of the target robot to move its joint, a body ' +
  'of the robot to apply a spring force; click to select. Elsewhere, or with Alt: drag to rotate the ' +
  'view, right button to pan, wheel to zoom. While dragging: shift for vertical motion, wheel for depth. ' +
  'Touch: one finger acts as the mouse, two fingers pan and zoom. Game controller: left stick right and ' +
  'up, right stick yaw and toward, first button gripper, second clutch.';
