// What goes between the lab and its page. TypeScript's types are the description: the page compiles
// against them, docs/reference/lab_protocol.md shows them, and tests/cli/test_lab_protocol.py holds the
// program's messages and commands against them. World frame: z up; metres, seconds, radians, newtons.
import type { Equation, Inspection, Neighbour, PassStep } from './inspection';
import type { Channel, LegendLine, View } from './run';

export type Vector = [number, number, number];

export interface SceneLayer {
  name: string; // "bodies" first; the last, "before", is the robot of the branch that was left
  what: string;
  legend: LegendLine[];
}

export interface SceneChannel {
  name: string; // "q/arm1"
  unit: string; // SI
  kind: Channel['kind'] | 'pull' | 'hand' | 'time' | 'lane';
  of: string;
}

export interface SceneBody {
  name: string;
  moves: boolean;
  robot: boolean;
}

export interface SceneJoint {
  name: string;
  body: number;
  low?: number; // absent: no limit
  high?: number;
  driven?: number; // its place in hand.q; absent: the hand does not drive it
  axis?: Vector; // link axes of `body`, through its origin; absent: it has not one axis
  slides?: boolean; // along the axis, else about it
}

export interface SceneMessage {
  kind: 'scene';
  scene: number; // counts up; frames carry it
  title: string;
  file: string;
  look: string[]; // what to look for
  meshes: string[]; // hashes, by number in frames
  textures: string[];
  layers: SceneLayer[];
  channels: SceneChannel[];
  ledger: string[];
  bodies: SceneBody[];
  joints: SceneJoint[];
  tip?: { body: number; p: Vector }; // the point that the hand leads, link axes
  view: View;
}

export interface Limit {
  value: number | null;
  words: string; // "stable up to 12 kN/m at this step"
  state: 'ok' | 'near' | 'beyond';
}

export interface Knob {
  path: string; // "coupling.stiffness"
  label: string;
  group: string;
  value: number | string | null; // null: the scene leaves it out
  start?: string; // as the scene was opened; '': left out; absent: it had no such knob
  unit: string;
  form: 'log' | 'linear' | 'choice' | 'number';
  low: number;
  high: number;
  choices: string[];
  meaning: string;
  limit?: Limit;
  lag?: string; // "0.9 degrees at 1 rad/s"
  restarts: boolean;
}

export interface Remedy {
  words: string;
  changes: string[];
}

export interface Death {
  words: string[];
  time: number;
  from: number; // the last change: to go on from with a remedy
  quantity: string; // '': none, as body and spring
  body: string;
  spring: string;
  remedies: Remedy[];
}

export interface Note {
  n: number;
  level: 'note' | 'warning' | 'error';
  text: string;
}

export interface HandState {
  source: 'scene' | 'drag' | 'joints' | 'device' | ''; // '': no hand leads this scene
  spec: string; // of a device, as it was chosen after --device; else ''
  mapping: string; // "paper", "arm", "cartesian"
  q: number[]; // targets of the driven joints
  felt: string; // what device it is, in words
  mode: string; // of a device: live, held (it is silent), released (silent for longer); else ''
  gripper: boolean; // closed
  trace?: string; // file of a recorded hand, where one lies with the program
}

// Variants side by side.
export interface Lanes {
  path: string;
  values: string[];
  stopped: (number | null)[]; // when one stopped [s]
}

export interface Branch {
  from: number;
  changes: string[];
  number: number;
}

export interface StateMessage {
  kind: 'state';
  scene: number;
  you: number;
  secret: string; // of this page: goes with an upload
  holder: number | null; // of the hand; null: nobody
  clients: number;
  asked: number[]; // who asks for the hand
  playing: boolean;
  speed: number;
  time: number;
  first: number; // what is remembered [s]
  last: number;
  at: number | null; // the instant that is looked at, if not the newest
  branch: Branch | null;
  lanes: Lanes | null;
  pace: number;
  step: number;
  step_us: number;
  hand: HandState;
  knobs: Knob[];
  presets: { name: string; what: string }[];
  gallery: { name: string; title: string; look: string[] }[];
  name: string; // of the gallery
  changes: string[]; // to the scene's file
  building: string; // what is being prepared
  dead: Death | null;
  notes: Note[]; // the last twenty
}

// What the inspector tells of one body in one frame. Absent: the frame could not be looked into,
// and a warning says why.
export interface BodyInspection extends Partial<Inspection> {
  kind: 'glass';
  scene: number;
  t?: number; // absent: of a state alone
  step?: number;
  stands: boolean;
  body?: number;
  name?: string;
  equations?: Equation[];
  neighbours?: Neighbour[];
  rows?: Omit<PassStep, 'joint'>[]; // the whole call in its order, where time stands
}

// Those marked * need no hand.
export type Command =
  | { do: 'layers'; names: string[] } // * which layers come in this client's frames
  | { do: 'glass'; on: boolean; body?: number } // * inspection of a body comes, or not
  | { do: 'look'; at: number | null } // * this instant is shown (to all); null: the newest
  | { do: 'take' } // * asks for the hand; it is given at once where nobody holds it
  | { do: 'give'; to: number } // * the hand
  | { do: 'play'; on: boolean } // goes on, or stands
  | { do: 'step'; steps: number } // so many, then it stands
  | { do: 'speed'; factor: number } // run time over wall time, 0.001 to 10
  | { do: 'set'; changes: string[] } // "coupling.stiffness=800": turns knobs, at this instant
  | { do: 'branch'; at: number | null; changes: string[] } // back to that instant, and on from there
  | { do: 'preset'; name: string } // all of its values, and its scene
  | { do: 'scene'; name: string } // another one of the gallery
  | { do: 'reset' } // to the start
  | { do: 'restore' } // all knobs as the scene was opened, at this instant
  | { do: 'hand'; source: 'scene' | 'drag' | 'joints' | 'device'; spec?: string } // who moves the robot
  | { do: 'tip'; goal: Vector; stamp: number } // where the tip of the kinematic robot is dragged to
  | { do: 'joint'; index: number; value: number; stamp: number } // a driven joint is dragged there
  | { do: 'turn'; yaw: number; pitch: number; roll: number; stamp: number } // the stylus
  | { do: 'axes'; rates: number[]; stamp: number } // right, up, toward, yaw, pitch, roll: -1 to 1
  | { do: 'button'; index: number; down: boolean; stamp: number } // 0: gripper, 1: clutch
  | { do: 'pull'; body: number; point: Vector; goal: Vector; stamp: number } // point: link axes
  | { do: 'drop' }; // spring, axes and clutch are released, the gripper stays as it is

// Whether it differs from what the scene came with.
export function isTurned({ value, start }: Knob): boolean {
  if (start === undefined) return false;
  return typeof value === 'number' && start !== '' ? Number(start) !== value : start !== (value ?? '');
}

// Somebody else holds the hand.
export function watches({ holder, you }: StateMessage): boolean {
  return !!holder && holder !== you;
}
