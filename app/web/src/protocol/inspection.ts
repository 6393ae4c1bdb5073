// Output of `twinarm inspect --json`, and the data of its page.
import type { PageData } from './run';

export type Value = number | number[] | number[][];

export interface Quantity {
  name: string;
  meaning: string;
  unit: string; // of both halves of a vector: "N m; N"
  frame: string;
  equation: string;
  value: Value;
}

export interface PassStep {
  pass: number;
  body: string;
  joint: string;
  quantities: Quantity[];
}

export interface Wrench {
  source: string;
  force: number[];
  torque: number[];
}

export interface Balance {
  body: string;
  about: number[];
  wrenches: Wrench[];
  largest: number;
  residual: number;
}

export interface Check {
  name: string;
  meaning: string;
  error: number;
  tolerance: number;
  body: string;
  pass: boolean;
}

// A named force: coupling, contact, constraint, actuator or applied wrench.
export interface NamedForce {
  source: string;
  point?: number[]; // world
  axis?: number[]; // of a contact: normal, towards the second body, world
  normal?: number; // normal force N [N]
  friction?: number; // friction force |Ft| [N]
  unique?: boolean; // false: other constraint forces give the same accelerations
  on: { body: string; force: number[]; torque: number[]; about: number[] }[];
  joints: { joint: string; component: number; value: number }[];
}

// Joint forces at one degree of freedom; they sum to zero.
export interface JointBalance {
  joint: string;
  component: number;
  unit: string; // "N m", "N"; "N m; N" of several degrees of freedom
  torques: { source: string; value: number }[];
  residual: number;
}

// Term of an equation, and the body that it comes from.
export interface Term {
  symbol: string; // "Xup v_p"; "- ..." where it is subtracted
  words: string;
  of: string;
  value: Value;
}

export interface Equation {
  pass: number;
  name: string; // of the left side: "v", "D qdd"
  text: string;
  terms: Term[];
  value: Value;
  residual: number | null;
}

export interface AdjacentBody {
  body: string;
  is: 'parent' | 'child';
  quantities: Quantity[];
}

export interface Inspection {
  passes: PassStep[];
  balance: Balance[];
  joint_balance: JointBalance[];
  forces: NamedForce[];
  energy_balance?: Record<string, number>; // of a recording, or of the lab [J]
  checks: Check[];
  axes: string;
  about: string;
  warnings: string[];
}

// Layers: "body/NAME" for each body, "body/world", and the overlays; of one frame.
export interface InspectedRobot extends PageData {
  title: string;
  state: string;
  command: string;
  version: string;
  inspection: Inspection;
}
