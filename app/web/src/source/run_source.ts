// A run that plots and tables show: one that a page carries (Player), or one that goes on in a lab
// (LiveRun).
import { decodeHistory, RunRecord } from './run_record';
import type { LabPage, Listener } from '../panels/panel';
import type { Frame, SceneMessage, StateMessage } from './link';

export interface RunSource {
  readonly record: RunRecord | null; // null: nothing has come yet
  readonly at: number | null; // the instant that is shown [s]; null: the newest
  readonly stepSize: number; // [s]
  readonly hasDiverged: boolean;
  readonly isLive: boolean; // more will come
  look(time: number): void;
}

const REFILL = 3000; // how often missed frames are asked for [ms]

// What the page remembers of the lab's run. Frames that it missed come from the lab's memory.
export class LiveRun implements RunSource, Listener {
  readonly isLive = true;
  record: RunRecord | null = null;
  private askedAt = -Infinity;
  private asking = false;

  constructor(private readonly page: LabPage) {
    // Hidden pages get no pictures, and so no frames.
    document.addEventListener('visibilitychange', () => this.fill());
  }

  get at(): number | null {
    return this.page.state?.at ?? null;
  }
  get stepSize(): number {
    return this.page.state?.step ?? 1e-3;
  }
  get hasDiverged(): boolean {
    return (this.page.state?.dead ?? null) !== null;
  }

  look(time: number): void {
    this.page.send({ do: 'look', at: time });
  }

  onScene(scene: SceneMessage): void {
    const old = this.record?.scene;
    const isSame = old?.scene === scene.scene;
    const names = ({ channels, ledger }: Pick<SceneMessage, 'channels' | 'ledger'>) =>
      JSON.stringify([channels, ledger]);
    if (!isSame || names(old) !== names(scene))
      this.record = isSame ? this.record!.grownTo(scene) : new RunRecord(scene);
    // A connection that was lost has missed frames too.
    this.record!.lost = isSame ? (this.record!.lost ?? this.record!.store.last) : -Infinity;
    this.askedAt = -Infinity;
  }

  onState(state: StateMessage): void {
    this.record?.onState(state);
  }

  onFrame(frame: Frame): void {
    this.record?.addFrame(frame);
    this.fill();
  }

  private fill(): void {
    const { record } = this;
    const now = performance.now();
    if (!record || record.lost === null || this.asking || now - this.askedAt < REFILL) return;
    this.asking = true;
    this.askedAt = now;
    void this.ask(record, record.lost).finally(() => (this.asking = false));
  }

  private async ask(record: RunRecord, lost: number): Promise<void> {
    const { epoch } = record;
    record.lost = null;
    const from = Number.isFinite(lost) ? lost : 0;
    try {
      const answer = await fetch(`/history?from=${from}`);
      const history = answer.ok ? decodeHistory(await answer.arrayBuffer()) : null;
      if (history && epoch === record.epoch) record.addHistory(history);
    } catch {
      record.lost = Math.min(lost, record.lost ?? Infinity); // no connection: later
    }
  }
}
