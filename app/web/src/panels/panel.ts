// Interface between a page and its panels.
//
// The page calls the functions that a panel has: onScene, onState and onInspection when a message comes,
// onFrame and draw when the next picture is made, onFrame with the newest frame only. A hidden panel gets
// all calls but draw.
import type { BodyInspection } from '../protocol/messages';
import type { Operator } from '../input/operator';
import type { Arrow } from '../view/arrows';
import type { Command, Frame, SceneMessage, StateMessage } from '../source/link';

export interface Listener {
  onScene?(scene: SceneMessage): void;
  onState?(state: StateMessage): void;
  onFrame?(frame: Frame): void;
  onInspection?(inspection: BodyInspection): void;
  onSelect?(body: number | null): void;
  onTheme?(): void; // the theme or the panel's size has changed: canvases are redrawn
}

export interface Panel extends Listener {
  root: HTMLElement;
  draw?(): void; // once per picture, while visible
}

// The page, as panels use it.
export interface LabPage {
  readonly scene: SceneMessage | null; // the newest
  readonly state: StateMessage | null; // the newest
  readonly frame: Frame | null; // the newest of the scene
  readonly selected: number | null; // body
  readonly operator: Pick<Operator, 'hasControl' | 'isGripperClosed' | 'button'>;
  // Requests control first, if the command needs it and no client has it. False: not sent.
  send(command: Command): boolean;
  select(body: number | null): void;
  // Shows a message at the bottom of the view for some seconds.
  showMessage(text: string): void;
  // Replaces the arrows in the view.
  arrows(arrows: Arrow[]): void;
}
