// What the lab's inspector tells of one body in one frame: app/lab/inspector/body_inspector.h.
import type { Inspection, PassStep, Quantity, Value } from './inspection';

export interface Term {
  symbol: string; // "Xup v_p", with its sign where that is a minus
  words: string;
  of: string; // the body that hands it over
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

export interface Neighbour {
  body: string;
  is: 'parent' | 'child';
  quantities: Quantity[];
}

// What a glance at a step tells.
export type CallStep = Omit<PassStep, 'joint'>;

// Absent: the frame could not be looked into, and a warning says why.
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
  rows?: CallStep[]; // the whole call in its order, where time stands
}
