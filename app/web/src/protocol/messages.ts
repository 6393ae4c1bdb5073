// What goes between the lab and its page, as docs/lab_protocol.md has it. World frame: z up;
// metres, seconds, radians, newtons.
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
  look: string[];
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

export type Limit = { value: number | null; words: string; state: 'ok' | 'near' | 'beyond' };

export interface Knob {
  path: string;
  label: string;
  group: string;
  value: number | string | null; // null: the scene leaves it out
  start?: string; // as the scene was opened; '': left out; absent: it had no such knob
  unit: string;
  form: 'log' | 'linear' | 'choice' | 'number';
  low?: number;
  high?: number;
  choices?: string[];
  meaning: string;
  limit?: Limit | null;
  lag?: string | null;
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
  quantity?: string;
  body?: string;
  spring?: string;
  remedies: Remedy[];
}

export interface Note {
  n: number;
  level: 'note' | 'warning' | 'error';
  text: string;
}

export interface HandState {
  source: 'scene' | 'drag' | 'joints' | 'device' | ''; // '': no hand leads this scene
  spec: string; // of a device, as it was chosen
  mapping: string;
  q: number[];
  felt: string; // what device it is
  mode?: string; // live, held, released
  trace?: string; // file of a recorded hand
}

export interface StateMessage {
  kind: 'state';
  you: number;
  secret: string; // of this page: goes with an upload
  holder: number | null; // 0, null: nobody
  clients: number;
  asked: number[]; // who asks for the hand
  playing: boolean;
  speed: number;
  time: number;
  first: number; // what is remembered [s]
  last: number;
  at: number | null; // the instant that is looked at, if not the newest
  branch: { from: number; changes: string[]; number: number } | null;
  pace: number;
  step: number;
  step_us: number;
  hand?: HandState | null;
  knobs: Knob[];
  presets: { name: string; what: string }[];
  gallery: { name: string; title: string; look: string[] }[];
  name?: string; // of the gallery
  changes?: string[]; // to the scene's file
  building?: string; // what is being prepared
  dead: Death | null;
  notes: Note[];
}

export type Command =
  | { do: 'layers'; names: string[] }
  | { do: 'glass'; on: boolean; body?: number; pass?: number }
  | { do: 'look'; at: number | null }
  | { do: 'take' }
  | { do: 'give'; to: number }
  | { do: 'play'; on: boolean }
  | { do: 'step'; steps: number }
  | { do: 'speed'; factor: number }
  | { do: 'set'; changes: string[] }
  | { do: 'branch'; at: number; changes: string[] }
  | { do: 'preset'; name: string }
  | { do: 'scene'; name: string }
  | { do: 'reset' }
  | { do: 'restore' }
  | { do: 'hand'; source: 'scene' | 'drag' | 'joints' | 'device'; spec?: string }
  | { do: 'tip'; goal: Vector; stamp: number }
  | { do: 'joint'; index: number; value: number; stamp: number }
  | { do: 'turn'; yaw: number; pitch: number; roll: number; stamp: number }
  | { do: 'axes'; rates: number[]; stamp: number }
  | { do: 'button'; index: number; down: boolean; stamp: number }
  | { do: 'pull'; body: number; point: Vector; goal: Vector; stamp: number }
  | { do: 'drop' };

// Whether it differs from what the scene came with.
export function isTurned({ value, start }: Knob): boolean {
  if (start === undefined) return false;
  return typeof value === 'number' && start !== '' ? Number(start) !== value : start !== (value ?? '');
}

// Somebody else holds the hand.
export function watches({ holder, you }: StateMessage): boolean {
  return !!holder && holder !== you;
}
