// Commands that move the robot. Of each kind only the newest is kept; they are sent once per picture with the
// time of the input, from which the delay until its picture is measured.
import type { Command, Frame, Link, StateMessage } from '../source/link';

type Moves = Extract<Command, { stamp: number }>;
// Of a union, member by member.
type Unstamped = Moves extends infer M ? (M extends Moves ? Omit<M, 'stamp'> : never) : never;

const KEPT = 240; // stamps and delays

export class Operator {
  readonly delays: number[] = []; // from an input to its picture [ms], the newest last
  clutch = false;
  private readonly pending = new Map<string, Unstamped>();
  private readonly stamps = new Set<number>();
  private painted = 0; // stamp

  constructor(
    private readonly link: Link,
    private readonly state: () => StateMessage | null,
    private readonly showMessage: (text: string) => void,
  ) {}

  get isGripperClosed(): boolean {
    return this.state()?.input.gripper ?? false;
  }
  get hasControl(): boolean {
    const state = this.state();
    return state !== null && state.controller === state.you;
  }

  // Requests control if this page does not have it. False: another client has it.
  requestControl(): boolean {
    const state = this.state();
    if (!state || this.hasControl) return state !== null;
    this.link.send({ do: 'request_control' });
    if (!state.controller) return true; // granted at once
    if (!state.control_requests.includes(state.you)) this.showMessage('Another client has control. Control requested.');
    return false;
  }

  // Makes the pointer the input source of the target robot.
  useSource(source: 'drag' | 'joints'): boolean {
    if (!this.requestControl()) return false;
    if (this.state()?.input.source !== source) this.link.send({ do: 'input', source });
    return true;
  }

  // Sent with the next picture, unless replaced by a newer command of its kind.
  move(command: Unstamped): void {
    this.pending.set(command.do === 'joint' ? `joint${command.index}` : command.do, command);
  }
  button(index: 0 | 1, down: boolean): boolean {
    if (!this.requestControl()) return false;
    this.sendNow({ do: 'button', index, down });
    if (index === 1) this.clutch = down;
    return true;
  }
  releaseSpring(): void {
    this.pending.delete('drag_body');
    this.link.send({ do: 'release' });
  }

  // Once per picture.
  flush(): void {
    for (const command of this.pending.values()) this.sendNow(command);
    this.pending.clear();
  }

  // After the frame has been drawn.
  measureDelay({ stamp }: Frame): void {
    if (stamp === this.painted || !this.stamps.has(stamp)) return; // known, or of another client
    this.painted = stamp;
    this.delays.push(performance.now() - stamp);
    if (this.delays.length > KEPT) this.delays.shift();
  }

  private sendNow(command: Unstamped): void {
    const stamp = performance.now();
    this.link.send({ ...command, stamp } as Command);
    this.stamps.add(stamp);
    if (this.stamps.size > KEPT) this.stamps.delete(this.stamps.values().next().value!);
  }
}
