// The connection to the lab. Of frames only the newest is kept, and nobody looks at it before the
// next picture is drawn: a page that draws slowly sees less, never later. A lost connection is
// tried again until it holds.
import { decodeFrame, type Frame } from './frame';
import type { Command, GlassMessage, SceneMessage, StateMessage } from './messages';

export * from './frame';
export * from './messages';

export interface Listener {
  scene(message: SceneMessage): void;
  state(message: StateMessage): void;
  glass(message: GlassMessage): void;
  connection(open: boolean): void;
}

const FIRST_PAUSE = 250; // [ms]
const LONGEST_PAUSE = 2000;

export class Link {
  open = false;
  received = 0; // frames, shown or not
  private socket: WebSocket | null = null;
  private waiting: ArrayBuffer | null = null;
  private pause = FIRST_PAUSE;
  private timer = 0;

  constructor(
    private readonly url: string,
    private readonly listener: Listener,
  ) {
    addEventListener('online', () => this.connect());
    document.addEventListener('visibilitychange', () => {
      if (!document.hidden) this.connect();
    });
    this.connect();
  }

  // False: there is no connection, and it is not kept: a hand's movement of a while ago is no use.
  send(command: Command): boolean {
    if (!this.open) return false;
    this.socket!.send(JSON.stringify(command));
    return true;
  }

  // The newest frame, once; null: none has come since.
  take(): Frame | null {
    const newest = this.waiting;
    this.waiting = null;
    return newest && decodeFrame(newest);
  }

  // At once, if there is none.
  connect(): void {
    clearTimeout(this.timer);
    if (this.socket) return;
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.open = true;
      this.pause = FIRST_PAUSE;
      this.listener.connection(true);
    };
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => this.receive(data);
    socket.onclose = () => this.lose();
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== 'string') {
      this.waiting = data;
      this.received += 1;
      return;
    }
    const message = JSON.parse(data) as SceneMessage | StateMessage | GlassMessage;
    if (message.kind === 'scene') this.listener.scene(message);
    else if (message.kind === 'state') this.listener.state(message);
    else if (message.kind === 'glass') this.listener.glass(message);
  }

  private lose(): void {
    this.socket = null;
    this.open = false;
    this.waiting = null;
    this.listener.connection(false);
    this.timer = setTimeout(() => this.connect(), this.pause);
    this.pause = Math.min(2 * this.pause, LONGEST_PAUSE);
  }
}
