// Run shown by plots and tables: recorded (Player), or live in the lab (LiveRun).
import { decodeHistory, RunRecord } from './run_record';
import type { LabPage, Listener } from '../panels/panel';
import type { Frame, SceneMessage, StateMessage } from './link';

export interface RunSource {
  readonly record: RunRecord | null; // null: no data yet
  readonly at: number | null; // instant shown [s]; null: the newest
  readonly stepSize: number; // [s]
  readonly hasDiverged: boolean;
  readonly isLive: boolean;
  look(time: number): void;
}

const REFILL = 3000; // between requests of missed frames [ms]

// Missed frames are fetched from the lab's buffer.
export class LiveRun implements RunSource, Listener {
  readonly isLive = true;
  record: RunRecord | null = null;
  private requestedAt = -Infinity;
  private retry = 0; // timer
  private isRequesting = false;

  constructor(private readonly page: LabPage) {
    // A hidden page draws no pictures and so takes no frames.
    document.addEventListener('visibilitychange', () => this.fill());
  }

  get at(): number | null {
    return this.page.state?.at ?? null;
  }
  get stepSize(): number {
    return this.page.state?.step ?? 1e-3;
  }
  get hasDiverged(): boolean {
    return (this.page.state?.failure ?? null) !== null;
  }

  look(time: number): void {
    this.page.send({ do: 'seek', at: time });
  }

  onScene(scene: SceneMessage): void {
    const old = this.record?.scene;
    const isSame = old?.scene === scene.scene;
    const names = ({ channels, energy_balance }: Pick<SceneMessage, 'channels' | 'energy_balance'>) =>
      JSON.stringify([channels, energy_balance]);
    if (!isSame || names(old) !== names(scene))
      this.record = isSame ? this.record!.grownTo(scene) : new RunRecord(scene);
    // Frames were missed while the connection was lost.
    this.record!.lost = isSame ? (this.record!.lost ?? this.record!.store.last) : -Infinity;
    this.requestedAt = -Infinity;
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
    if (!record || record.lost === null || this.isRequesting) return;
    const early = REFILL - (now - this.requestedAt);
    if (early > 0) {
      clearTimeout(this.retry);
      this.retry = window.setTimeout(() => this.fill(), early);
      return;
    }
    this.isRequesting = true;
    this.requestedAt = now;
    void this.request(record, record.lost).finally(() => {
      this.isRequesting = false;
      this.fill(); // no frame may follow that asks again
    });
  }

  private async request(record: RunRecord, lost: number): Promise<void> {
    const { epoch } = record;
    record.lost = null;
    const from = Number.isFinite(lost) ? lost : 0;
    try {
      const answer = await fetch(`/history?from=${from}`);
      const history = answer.ok ? decodeHistory(await answer.arrayBuffer()) : null;
      // Meanwhile a scene that grew may have replaced the record.
      if (history && epoch === this.record!.epoch) return this.record!.addHistory(history);
    } catch {
      // Not connected.
    }
    this.record!.lost = Math.min(lost, this.record!.lost ?? Infinity); // retried later
  }
}
