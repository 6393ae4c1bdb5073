// What the page and its panels know of one another.
//
// The page calls a panel where the panel has such a function: onScene and onState when a message
// comes, onFrame and draw only when the next picture is made, onFrame with the newest frame alone.
// A panel that is not seen (its tab is closed) gets everything but draw.
import type { BodyInspection } from '../protocol/messages';
import type { Arrow } from '../view/arrows';
import type { Command, Frame, SceneMessage, StateMessage } from '../source/link';
import { Gallery } from './gallery';
import { InputBar } from './input_bar';
import { Parameters } from './parameters';
import { EnergyPanel } from './balances';
import { Plots } from '../plot/plots';
import type { RunSource } from '../source/run_source';
import { Notes } from './menus';
import { Diverged } from './diverged';
import { LabTimeBar } from './lab_time_bar';

export interface Listener {
  onScene?(scene: SceneMessage): void;
  onState?(state: StateMessage): void;
  onFrame?(frame: Frame): void;
  onGlass?(inspection: BodyInspection): void;
  onSelect?(body: number | null): void;
  onTheme?(): void; // light or dark has changed, or the panel's size: canvases draw again
}

export interface Panel extends Listener {
  root: HTMLElement;
  draw?(): void; // once a picture, while it is seen
}

// The page, as panels see it.
export interface LabPage {
  readonly scene: SceneMessage | null; // the newest of each
  readonly state: StateMessage | null;
  readonly selected: number | null; // body
  readonly hand: { readonly grip: boolean; button(index: 0 | 1, down: boolean): void };
  readonly holds: boolean; // the hand: it may send all commands
  // Commands that need the hand ask for it first where nobody has it. False: not sent.
  send(command: Command): boolean;
  select(body: number | null): void;
  // A line at the lower edge of the view, gone after a while.
  say(words: string): void;
  // Arrows in the view, in the place of those that the same owner had: free-body diagrams.
  arrows(owner: string, arrows: Arrow[]): void;
  showTab(title: string): void;
}

// All panels of the lab but the inspector: `time` is the bar below the view, `hand` lies in the
// view's lower corner, `gallery` is a dialog, `dead` lies over the view and hides itself.
export function panelsOf(page: LabPage, run: RunSource) {
  const knobs = new Parameters(page);
  const time = new LabTimeBar(page, () => knobs.changes);
  const notes = new Notes();
  time.add(notes);
  return {
    knobs,
    plots: new Plots(run),
    ledger: new EnergyPanel(run),
    time,
    hand: new InputBar(page),
    gallery: new Gallery(page),
    dead: new Diverged(page, time.rewind),
  };
}

export type PanelSet = ReturnType<typeof panelsOf>;
