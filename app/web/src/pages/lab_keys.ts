// The keyboard of the lab: everything that a mouse can do.
import { clockKeys, key, type Key, viewKeys } from '../ui/keys';
import type { ViewName } from '../view/stage';
import type { Operator } from '../input/operator';
import type { KeyInput } from '../input/key_input';
import type { LabPage, PanelSet } from '../panels/panel';
import type { Overlays, Views } from '../view/view_options';
import type { LiveStage } from '../view/live_stage';

// What its keys need of the page.
export interface LabKeys extends LabPage {
  readonly set: PanelSet;
  readonly live: LiveStage;
  readonly overlays: Overlays;
  readonly views: Views;
  readonly hand: Operator;
  readonly keys: KeyInput;
  look(name: ViewName): void;
  isTab(title: string): boolean;
  togglePanel(): void;
  toggleTheme(): void;
}

const FRAME = 1 / 60; // [s]

export function labKeys(page: LabKeys): Key[] {
  return [...runKeys(page), ...handKeys(page), ...pictureKeys(page), ...pageKeys(page)];
}

function runKeys(page: LabKeys): Key[] {
  const { time } = page.set;
  const step = () => {
    if (!page.isTab('Glass')) page.send({ do: 'step', steps: 1 }); // else a step of the call
  };
  return [
    ...clockKeys(time),
    key('.', 'one step of the run (beside the Glass: of the call; , back)', step),
    key('End', 'back to now', () => time.seek(Infinity)),
    key('b', 'branch from this instant', () => time.askBranch()),
  ];
}

// Arrows move what the hand has; without it they look back in time.
function handKeys(page: LabKeys): Key[] {
  const { hand, keys, set: { time } } = page;
  const move = (right: number, up: number, away: number) => (event: KeyboardEvent) => {
    if (keys.isOn) return keys.move(right, up, away, event.shiftKey);
    const { state } = page;
    if (!state || right === 0) return;
    time.seek((state.at ?? state.last) + right * (event.shiftKey ? 0.5 : FRAME));
  };
  return [
    key('h', 'the hand: arrows move the tip, page up and down away and toward', () => keys.focusTip()),
    key('j', 'the next joint: arrows turn it', () => keys.nextJoint()),
    key('x', 'a spring at the selected body: arrows pull; x lets go', () => keys.togglePull(page.selected)),
    key('← →', 'else: back and on in time; with shift half a second', {
      ArrowLeft: move(-1, 0, 0),
      ArrowRight: move(1, 0, 0),
      ArrowUp: move(0, 1, 0),
      ArrowDown: move(0, -1, 0),
      PageUp: move(0, 0, 1),
      PageDown: move(0, 0, -1),
    }),
    key('g', 'gripper', () => {
      const closed = !hand.grip;
      if (hand.button(0, closed)) page.say(`The gripper is ${closed ? 'closed' : 'open'}.`);
    }),
    key('c', 'clutch', () => {
      if (hand.button(1, !hand.clutch)) page.say(`The clutch is ${hand.clutch ? 'pressed' : 'released'}.`);
    }),
  ];
}

function pictureKeys(page: LabKeys): Key[] {
  const { live, overlays, views } = page;
  const selectNext = (by: number) => () => {
    const { scene } = page;
    if (!scene) return;
    const moving = scene.bodies.flatMap(({ moves }, i) => (moves ? [i] : []));
    const at = page.selected === null ? -1 : moving.indexOf(page.selected);
    page.select(moving[(at + by + moving.length) % moving.length] ?? null);
  };
  return [
    key('m', 'select the next body; with shift the one before', { m: selectNext(1), M: selectNext(-1) }),
    ...viewKeys({
      orbit: (...by) => live.stage?.orbit(...by),
      look: (name) => page.look(name),
      followNext: () => views.next(page.selected),
      toggleLayer: (number) => overlays.toggleNumber(number),
      toggleTheme: () => page.toggleTheme(),
    }),
    key('o', 'what is shown', () => overlays.fold(!overlays.folded)),
  ];
}

function pageKeys(page: LabKeys): Key[] {
  const { keys, overlays, set: { gallery } } = page;
  const tab = (title: string) => () => page.showTab(title);
  const tabs = { n: tab('Knobs'), p: tab('Plots'), i: tab('Glass'), l: tab('Ledger') };
  const leave = () => {
    if (!overlays.folded) overlays.fold(true);
    else if (keys.isOn) keys.leave();
    else page.select(null);
  };
  return [
    key('n p i l', 'knobs, plots, glass, ledger', tabs),
    key('\\', 'fold the panel away', () => page.togglePanel()),
    key('e', 'scenes', () => gallery.root.showModal()),
    key('Esc', 'lets go of the hand, of the selection', { Escape: leave }),
  ];
}

// Sliders, tabs and dialogs keep the keys that they know.
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
  'Mouse: the ring at the tip leads the robot, its ghost turns joint by joint, a solid body is ' +
  'pulled by a spring; a click selects it. Elsewhere dragging turns the view, the right button ' +
  'moves it, the wheel zooms; with Alt, everywhere. While dragging, shift goes straight up and ' +
  'down, the wheel nearer and farther. One finger is a mouse, two move and zoom the view. A game ' +
  'controller moves the hand: left stick right and toward, right stick up and yaw, first button grips.';
