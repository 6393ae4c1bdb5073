// What `twinarm inspect --json` tells, and the picture beside it.
import type { Layer, MeshData, View } from './run';

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

export interface Inspection {
  passes: PassStep[];
  balance: Balance[];
  checks: Check[];
  axes: string;
  about: string;
  warnings: string[];
}

export interface InspectedRobot {
  title: string;
  state: string;
  command: string;
  version: string;
  inspection: Inspection;
  meshes: MeshData[];
  textures: ImageBitmap[];
  // "body/NAME" for each body, "body/world", and the overlays; of one frame.
  layers: Layer[];
  texts: string[];
  view: View;
}
