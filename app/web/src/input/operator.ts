// What moves the robot from the page: commands of the hand. Of each kind only the newest waits, and
// they go out once a picture, with the time at which they were made; so the page also knows how
// long it takes until it sees what it did.
import type { Command, Frame, Link, StateMessage } from '../source/link';

type Moves = Extract<Command, { stamp: number }>;
// Of a union, member by member.
type Unstamped = Moves extends infer M ? (M extends Moves ? Omit<M, 'stamp'> : never) : never;

const KEPT = 240; // stamps and delays

export class Operator {
  readonly delays: number[] = []; // from a movement to its picture [ms], the newest last
  clutch = false;
  private readonly waiting = new Map<string, Unstamped>();
  private readonly stamps = new Set<number>();
  private seen = 0;

  constructor(
    private readonly link: Link,
    private readonly state: () => StateMessage | null,
    private readonly say: (words: string) => void,
  ) {}

  get grip(): boolean {
    return this.state()?.hand.gripper ?? false;
  }
  get holds(): boolean {
    const state = this.state();
    return state !== null && state.holder === state.you;
  }

  // Asks for the hand where this page has not got it. False: somebody else has it.
  claim(): boolean {
    const state = this.state();
    if (!state || this.holds) return state !== null;
    this.link.send({ do: 'take' });
    if (!state.holder) return true; // free: it is given at once
    if (!state.asked.includes(state.you)) this.say('Another page has the hand. It has been asked.');
    return false;
  }

  // The robot is led by this from now on.
  lead(source: 'drag' | 'joints'): boolean {
    if (!this.claim()) return false;
    if (this.state()?.hand.source !== source) this.link.send({ do: 'hand', source });
    return true;
  }

  // Goes out with the next picture, unless a newer one of its kind has come.
  move(command: Unstamped): void {
    this.waiting.set(command.do === 'joint' ? `joint${command.index}` : command.do, command);
  }
  button(index: 0 | 1, down: boolean): boolean {
    if (!this.claim()) return false;
    this.sendNow({ do: 'button', index, down });
    if (index === 1) this.clutch = down;
    return true;
  }
  drop(): void {
    this.waiting.delete('pull');
    this.link.send({ do: 'drop' });
  }

  // Once a picture.
  flush(): void {
    for (const command of this.waiting.values()) this.sendNow(command);
    this.waiting.clear();
  }

  // After the frame has been painted.
  painted(frame: Frame): void {
    const { stamp } = frame;
    if (stamp === this.seen || !this.stamps.has(stamp)) return; // shown before, or of another page
    this.seen = stamp;
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
