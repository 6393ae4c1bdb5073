// Data of a recorded run. World frame: z up, metres, radians; colours sRGB, one byte a channel.

import type { SceneChannel, SceneLayer } from './messages';

// A quantity over the frames.
export interface Channel extends SceneChannel {
  values: Float64Array; // one per frame
}

// Entries of a draw list, column by column; frame f has the entries first[f] to first[f + 1].
export interface InstanceColumns {
  first: Uint32Array;
  mesh: Uint16Array;
  flags: Uint8Array; // 1: also seen faintly where bodies hide it
  shininess: Uint8Array; // 255: polished
  color: Uint8Array; // r, g, b, a
  texture: Uint8Array; // 0: none, else one more than its index
  position: Float32Array; // x, y, z
  turn: Int16Array; // quaternion x, y, z, w in units of 1/32767
  scale: Float32Array; // x, y, z
}
export interface LabelColumns {
  first: Uint32Array;
  text: Uint32Array; // index into texts
  position: Float32Array;
  offset: Int16Array; // pixels to the right and down
}

// Row of the energy balance with the integration error, as recordings and messages name it.
export const NUMERICAL = 'numerical';

export interface LegendLine {
  color: [number, number, number];
  bar?: [number, number, number][]; // a colour bar from 0 to the value of the text
  text: string;
}

export interface Layer extends SceneLayer {
  shown: boolean; // at first
  instances: InstanceColumns;
  labels: LabelColumns;
}

export interface MeshData {
  position: Float32Array;
  normal: Float32Array;
  index: Uint32Array;
  uv: Float32Array; // from the upper left of a texture; empty: none
  twoSided: boolean; // an open surface
}

export interface View {
  eye: [number, number, number];
  target: [number, number, number];
  fieldOfView: number; // vertical
  light: [number, number, number]; // towards the light
  radius: number; // of the scene
  bottom: [number, number, number]; // of the background
  top: [number, number, number];
  ground: { visible: boolean; height: number; cell: number; cellsPerMajor: number };
}

// Data of every page for its 3-D view.
export interface PageData {
  meshes: MeshData[];
  textures: ImageBitmap[];
  layers: Layer[];
  texts: string[]; // of labels
  view: View;
}

export interface Run extends PageData {
  title: string;
  facts: [string, string][]; // name and value
  tables: { title: string; head: string[]; rows: string[][] }[];
  files: { name: string; text: string }[];
  notes: string[];
  command: string;
  times: Float64Array;
  channels: Channel[];
  energy_balance: { rows: string[]; works: Float64Array }; // frame by frame, row by row within a frame
  // Rows sum to the change of momentum: three numbers linear, three angular about the origin.
  momentum: { rows: string[]; values: Float64Array }; // frame by frame, row by row, six each
  bodies: string[]; // that have position channels
}

// Index of the first time later than t, in ascending times; their number: none.
export function firstAfter(times: Float64Array, t: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle + 1;
    else high = middle;
  }
  return low;
}
