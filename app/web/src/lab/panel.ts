// What the page and its panels know of one another.
//
// The page calls a panel where the panel has such a function: onScene and onState when a message
// comes, onFrame and draw only when the next picture is made, onFrame with the newest frame alone.
// A panel that is not seen (its tab is closed) gets everything but draw.
import type { Arrow } from '../view/arrows';
import type { Command, Frame, GlassMessage, Link, SceneMessage, StateMessage } from './link';

export interface Panel {
  root: HTMLElement;
  onScene?(scene: SceneMessage): void;
  onState?(state: StateMessage): void;
  onFrame?(frame: Frame): void;
  onGlass?(glass: GlassMessage): void;
  onSelect?(body: number | null): void;
  onTheme?(): void; // light or dark has changed, or the panel's size: canvases draw again
  draw?(): void; // once a picture, while it is seen
}

// The page, as panels see it.
export interface LabPage {
  readonly link: Link;
  readonly scene: SceneMessage | null; // the newest of each
  readonly state: StateMessage | null;
  readonly frame: Frame | null;
  readonly selected: number | null; // body
  readonly hand: { readonly grip: boolean; button(index: 0 | 1, down: boolean): void };
  readonly holds: boolean; // the hand: it may send all commands
  readonly dark: boolean;
  // Commands that need the hand ask for it first where nobody has it. False: not sent.
  send(command: Command): boolean;
  select(body: number | null): void;
  // A line at the lower edge of the view, gone after a while.
  say(words: string): void;
  // Arrows in the view, in the place of those that the same owner had: free-body diagrams.
  arrows(owner: string, arrows: Arrow[]): void;
  showTab(title: string): void;
}

// What lab/panels.ts gives the page: `export function panelsOf(page: LabPage): PanelSet`.
// lab/glass.ts gives one more: `export function glassOf(page: LabPage): Panel`.
export interface PanelSet {
  knobs: Panel;
  plots: Panel;
  ledger: Panel;
  time: Panel & { toggle(): void; askBranch(): void }; // the bar below the view
  hand: Panel; // in the view's lower corner: force with its limit
  gallery: Panel; // root: a <dialog> that the header's button opens
  dead: Panel; // over the view; hides itself
}
