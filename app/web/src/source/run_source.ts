// A run that plots and tables show: one that a page carries (player.ts), or one that goes on in a
// lab (live_run.ts).
import type { RunRecord } from './run_record';

export interface RunSource {
  readonly record: RunRecord | null; // null: nothing has come yet
  readonly at: number | null; // the instant that is shown [s]; null: the newest
  readonly stepSize: number; // [s]
  readonly hasDiverged: boolean;
  readonly isLive: boolean; // more will come
  look(time: number): void;
}
