// WebSocket of the lab. Only the newest message of each kind is kept, and decoded when the next picture is
// drawn: a slow page skips frames but adds no delay. Reconnects until the connection is open.
import { decodeFrame } from '../protocol/frame';
import type { BodyInspection, Command, SceneMessage, StateMessage } from '../protocol/messages';

export * from '../protocol/frame';
export * from '../protocol/messages';

export type News = ReturnType<Link['take']>;

const FIRST_PAUSE = 250; // [ms]
const LONGEST_PAUSE = 2000;
const SILENCE = 5000; // without a message the connection is lost, although it is open: the lab sends its state each second [ms]
const LISTENS = 1000; // so often [ms]
const KIND = /"kind":\s*"(\w+)"/; // precedes all names of the scene

export class Link {
  open = false;
  received = 0; // frames, drawn or not
  private socket: WebSocket | null = null;
  private waiting: ArrayBuffer | null = null;
  private readonly texts = new Map<string, string>(); // by kind
  private pause = FIRST_PAUSE;
  private timer = 0;
  private heard = 0; // time of the last message [ms]
  private listened = 0; // time of the last listen() [ms]

  constructor(private readonly url: string, private readonly changed: (open: boolean) => void) {
    addEventListener('online', () => this.connect());
    document.addEventListener('visibilitychange', () => {
      if (!document.hidden) this.connect();
    });
    setInterval(() => this.listen(), LISTENS);
    this.connect();
  }

  // False: not connected; the command is dropped, since old input is of no use later.
  send(command: Command): boolean {
    if (!this.open) return false;
    this.socket!.send(JSON.stringify(command));
    return true;
  }

  // The newest message of each kind, once; null: none since the last call.
  take() {
    const text = <T>(kind: string) => {
      const found = this.texts.get(kind);
      return found === undefined ? null : (JSON.parse(found) as T);
    };
    const news = {
      scene: text<SceneMessage>('scene'),
      state: text<StateMessage>('state'),
      inspection: text<BodyInspection>('inspection'),
      frame: this.waiting && decodeFrame(this.waiting),
    };
    this.waiting = null;
    this.texts.clear();
    return news;
  }

  connect(): void {
    clearTimeout(this.timer);
    if (this.socket) return;
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.open = true;
      this.heard = performance.now();
      this.pause = FIRST_PAUSE;
      this.changed(true);
    };
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => this.receive(data);
    socket.onclose = () => this.lose();
  }

  // A computer that slept, or another network: the socket stays open for minutes and says nothing. A busy
  // page receives waiting messages later.
  private listen(): void {
    const now = performance.now();
    if (now - this.listened > 2 * LISTENS) this.heard = Math.max(this.heard, now - SILENCE + 2 * LISTENS);
    this.listened = now;
    if (!this.open || now - this.heard < SILENCE) return;
    this.socket!.onclose = this.socket!.onmessage = null;
    this.socket!.close();
    this.lose();
  }

  private receive(data: string | ArrayBuffer): void {
    this.heard = performance.now();
    if (typeof data !== 'string') {
      this.waiting = data;
      this.received += 1;
      return;
    }
    const kind = KIND.exec(data)?.[1];
    if (kind) this.texts.set(kind, data);
  }

  private lose(): void {
    this.socket = null;
    this.open = false;
    this.waiting = null;
    this.changed(false);
    this.timer = setTimeout(() => this.connect(), this.pause);
    this.pause = Math.min(2 * this.pause, LONGEST_PAUSE);
  }
}
