// Messages between the lab and its page. These types are the specification: docs/reference/lab_protocol.md
// includes them, tests/cli/test_lab_protocol.py checks the program's messages and commands against them.
// World frame: z up; metres, seconds, radians, newtons.
import type { Equation, Inspection, AdjacentBody, PassStep } from './inspection';
import type { LegendLine, View } from './run';

export type Vector = [number, number, number];

export interface SceneLayer {
  name: string; // "bodies" first; the last, "earlier-run", is the robot of the previous branch
  what: string;
  legend: LegendLine[];
}

// Of a run; coordinate, target and error of a joint have the same `of`.
type RunKind = 'coordinate' | 'target' | 'error' | 'energy' | 'coupling' | 'contact' | 'position' | 'rate';

export interface SceneChannel {
  name: string; // "q/arm/joint1", "coupling/pull_arm1"
  unit: string; // SI
  kind: RunKind | 'mouse_spring' | 'device' | 'time' | 'contacts' | 'variant';
  of: string; // joint, coupling, pair, body
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
  driven?: number; // index into input.q; absent: not driven by the input
  axis?: Vector; // in link axes of `body`, through its origin; absent: not one axis
  slides?: boolean; // prismatic, else revolute
}

export interface SceneMessage {
  kind: 'scene';
  scene: number; // increases with each scene; frames repeat it
  title: string;
  file: string;
  look: string[]; // what to look for
  meshes: string[]; // hashes, by number in frames
  textures: string[];
  layers: SceneLayer[];
  channels: SceneChannel[];
  energy_balance: string[];
  bodies: SceneBody[];
  joints: SceneJoint[];
  tip?: { body: number; p: Vector }; // point of the target robot that the input moves, link axes
  view: View;
}

export interface Limit {
  value: number | null;
  words: string; // "stable up to 12 kN/m at this step"
  state: 'ok' | 'near' | 'beyond';
}

export interface LabParameter {
  path: string; // "coupling.stiffness"
  label: string;
  group: string;
  value: number | string | null; // null: not set in the scene
  start?: string; // when the scene was opened; '': not set; absent: no such parameter
  unit: string;
  form: 'log' | 'linear' | 'choice' | 'number';
  low: number;
  high: number;
  choices: string[];
  meaning: string;
  limit?: Limit;
  tracking_error?: string; // "0.9 degrees at 1 rad/s"
  restarts: boolean;
  folded: boolean; // its group is closed until it is asked for
}

export interface Remedy {
  words: string;
  changes: string[];
}

export interface Divergence {
  words: string[];
  time: number;
  from: number; // a remedy continues from there
  trying: boolean; // remedies are still being tried
  remedies: Remedy[]; // with these the run stays stable for 5 s beyond the stop
}

export interface Note {
  n: number;
  level: 'note' | 'warning' | 'error';
  text: string;
}

export interface InputState {
  source: 'scene' | 'drag' | 'joints' | 'device' | ''; // '': the scene has no target robot
  spec: string; // of a device, as after --device; else ''
  mapping: string; // "paper", "arm", "cartesian"
  q: number[]; // targets of the driven joints
  device_name: string; // description of the device
  mode: string; // of a device: live, held (sends nothing), released (watchdog timeout); else ''
  gripper: boolean; // closed
  trace?: string; // file of a recorded operator motion, if one is installed
}

// Variants side by side.
export interface Variants {
  path: string;
  values: string[];
  stopped: (number | null)[]; // time at which a variant diverged [s]
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
  secret: string; // of this page: required for uploads
  controller: number | null; // client with control; null: none
  clients: number;
  control_requests: number[]; // clients that request control
  playing: boolean;
  speed: number;
  time: number;
  first: number; // buffered run, from [s]
  last: number; // to [s]
  at: number | null; // instant shown [s]; null: the newest
  branch: Branch | null;
  variants: Variants | null;
  speed_ratio: number;
  step: number;
  step_us: number; // processor time of a step
  input: InputState;
  parameters: LabParameter[];
  presets: { name: string; what: string }[];
  gallery: { name: string; title: string; look: string[] }[];
  name: string; // of the gallery's scene
  changes: string[]; // relative to the scene file
  failure: Divergence | null;
  notes: Note[]; // the last twenty
}

// What the inspector shows of one body in one frame. Absent values: the frame could not be inspected; a
// warning says why.
export interface BodyInspection extends Partial<Inspection> {
  kind: 'inspection';
  scene: number;
  t?: number; // absent: of a state alone
  step?: number;
  paused: boolean;
  body?: number;
  name?: string;
  equations?: Equation[];
  neighbours?: AdjacentBody[];
  rows?: Omit<PassStep, 'joint'>[]; // all steps of the call, while paused
}

// Those marked * need no control.
export type Command =
  | { do: 'layers'; names: string[] } // * layers in this client's frames
  | { do: 'inspect'; on: boolean; body?: number } // * start or stop the inspection of a body
  | { do: 'seek'; at: number | null } // show this instant (to all clients); null: the newest
  | { do: 'request_control' } // * request control; granted at once if no client has it
  | { do: 'grant_control'; to: number } // * pass control to a client
  | { do: 'play'; on: boolean } // play or pause
  | { do: 'step'; steps: number } // take some steps, then pause
  | { do: 'speed'; factor: number } // run time over wall time, 0.001 to 10
  | { do: 'set'; changes: string[] } // "coupling.stiffness=800": set parameters, at this instant
  | { do: 'branch'; at: number | null; changes: string[] } // return to that instant and continue with changes
  | { do: 'preset'; name: string } // load its scene and values
  | { do: 'scene'; name: string } // open a scene of the gallery
  | { do: 'edit'; what: string; name?: string } // add "floor", "box", "sphere", "link-spring" (at link `name`),
  // "joint-springs"; "remove" body `name`; the run restarts
  | { do: 'reset' } // restart
  | { do: 'reset_parameters' } // all parameters as the scene was opened, at this instant
  | { do: 'input'; source: 'scene' | 'drag' | 'joints' | 'device'; spec?: string } // choose the input source
  | { do: 'drag_stylus'; goal: Vector; stamp: number } // goal of the target robot's tip
  | { do: 'joint'; index: number; value: number; stamp: number } // goal of a driven joint
  | { do: 'rotate_stylus'; yaw: number; pitch: number; roll: number; stamp: number } // angles of the stylus
  | { do: 'axes'; rates: number[]; stamp: number } // right, up, toward, yaw, pitch, roll: -1 to 1
  | { do: 'button'; index: number; down: boolean; stamp: number } // 0: gripper, 1: clutch
  | { do: 'drag_body'; body: number; point: Vector; goal: Vector; stamp: number } // mouse spring; point: link axes
  | { do: 'release' }; // release spring, axes and clutch; the gripper stays as it is

// Whether it differs from the value that the scene was opened with.
export function isChanged({ value, start }: LabParameter): boolean {
  if (start === undefined) return false;
  return typeof value === 'number' && start !== '' ? Number(start) !== value : start !== (value ?? '');
}

// Another client has control.
export const isViewOnly = ({ controller, you }: StateMessage): boolean => !!controller && controller !== you;
