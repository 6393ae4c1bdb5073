// 3-D view of the live run. Draws the newest frame without interpolation, which would delay it by one frame.
import { element, setText } from '../ui/dom';
import type { Part } from './painter';
import type { Overlays } from './view_options';
import { Stage } from './stage';
import { type Frame, labelText, placeOf, type SceneMessage } from '../source/link';
import { MeshStore } from '../source/meshes';

const [RIM, DARK_RIM] = ['#0067a5', '#6cb8ee']; // outline of the selected body: the accent colour
const FINE = new URLSearchParams(location.search).has('fine'); // full detail, for screenshots
const SHADOWS_AFTER = 300; // [ms]
const NO_DATA = { meshes: [], textures: [] };

export class LiveStage {
  stage: Stage | null = null; // null: before the first scene, or without WebGL
  private readonly gl = webGl(); // null: none
  private readonly isSlow = this.gl !== null && isSoftware(this.gl) && !FINE;
  // Time between pictures [ms]: without a graphics card at most 30 per second, since they are
  // computed on the processors that also compute the run.
  readonly interval = this.isSlow ? 30 : 0;
  readonly canDraw = this.gl !== null;
  private readonly store = new MeshStore();
  private readonly tag = element('div.tag', { hidden: '' });
  private scene: SceneMessage | null = null;
  private isSeen = false;
  private dark = false;
  private numbers = new Uint32Array(); // 0, 1, 2, ..

  // `card`: at the foot of the view.
  constructor(
    private readonly host: HTMLElement,
    handles: HTMLElement,
    private readonly changed: () => void,
    private readonly card: HTMLElement,
  ) {
    handles.append(this.tag);
  }

  // A scene with the same number only adds meshes, layers and channels.
  async show(scene: SceneMessage): Promise<void> {
    const before = this.scene;
    this.scene = scene;
    if (!this.canDraw) return;
    if (!this.stage) {
      // Creating a context takes 0.1 s in software: the probed one is used.
      const plain = this.isSlow ? this.gl : null;
      this.stage = new Stage(this.host, scene.view, NO_DATA, this.changed, plain, () => this.covered());
      if (!plain) this.gl!.getExtension('WEBGL_lose_context')?.loseContext();
      this.stage.setTheme(this.dark);
    } else if (before?.scene !== scene.scene) {
      this.stage.refurnish(scene.view);
      this.stage.setTheme(this.dark);
      this.stage.look('start');
    }
    const [meshes, textures] = await Promise.all([
      this.store.get(scene.meshes),
      this.store.images(scene.textures),
    ]);
    if (this.scene !== scene) return; // replaced meanwhile
    this.store.keepOnly([...scene.meshes, ...scene.textures]);
    const { painter } = this.stage;
    painter.add(meshes.slice(painter.geometries.length), textures.slice(painter.textures.length));
    this.changed();
  }

  private covered(): number {
    const { top, height } = this.card.getBoundingClientRect();
    return height > 0 ? this.host.getBoundingClientRect().bottom - top : 0;
  }

  setTheme(dark: boolean): void {
    this.dark = dark;
    this.stage?.setTheme(dark);
  }

  get isReady(): boolean {
    if (!this.canDraw) return true;
    return this.stage !== null && this.stage.painter.geometries.length === this.scene!.meshes.length;
  }

  // `selected`, `followed`: bodies.
  paint(frame: Frame, overlays: Overlays, selected: number | null, followed: number | null): void {
    const { stage, scene } = this;
    if (!stage || !scene) return;
    if (followed !== null) stage.follow(placeOf(frame.link, followed));
    const parts: Part[] = [];
    scene.layers.forEach(({ name }, l) => {
      if (l >= frame.layers || !overlays.isShown(name)) return;
      parts.push({ columns: frame, a: l, b: l, share: 0, shadow: l === 0 });
    });
    const marked = [...parts];
    if (selected !== null) {
      const outline = { color: this.dark ? DARK_RIM : RIM, of: (i: number) => frame.body[i] === selected };
      marked.push({ columns: frame, a: 0, b: 0, share: 0, outline });
    }
    stage.draw(marked);
    if (this.isReady && !this.isSeen) {
      this.isSeen = true;
      setTimeout(() => stage.addShadows(), SHADOWS_AFTER);
    }
    this.paintLabels(stage, frame, parts);
    this.paintTag(stage, frame, selected);
  }

  // Called when drawing is too slow. No effect without a graphics card.
  coarsen(): void {
    if (!this.isSlow && !FINE) this.stage?.coarsen();
  }

  private paintLabels(stage: Stage, frame: Frame, parts: Part[]): void {
    const count = frame.textEnd.length;
    if (this.numbers.length < count) this.numbers = Uint32Array.from({ length: 2 * count }, (_, i) => i);
    const { firstLabel: first, labelPosition: position, labelOffset: offset } = frame;
    const columns = { first, text: this.numbers, position, offset };
    const texts = Array.from({ length: count }, (_, i) => labelText(frame, i));
    const layers = count > 0 ? parts.map(({ a }) => ({ columns, frame: a })) : [];
    stage.labels.paint(stage.project, texts, layers);
  }

  // Name of the selected body.
  private paintTag(stage: Stage, frame: Frame, body: number | null): void {
    const place = body === null ? null : placeOf(frame.link, body);
    const at = place && stage.project(...place);
    this.tag.hidden = !at;
    if (!at || body === null) return;
    setText(this.tag, this.scene?.bodies[body]?.name ?? '');
    this.tag.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
  }
}

function webGl(): WebGL2RenderingContext | null {
  if (new URLSearchParams(location.search).has('plain')) return null; // for tests
  return document.createElement('canvas').getContext('webgl2', { antialias: false });
}

// Rendering without a graphics card.
function isSoftware(gl: WebGL2RenderingContext): boolean {
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const name = names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(name);
}

const EVERY = 200; // [ms]
const ALT = 'the robot, rendered by the server';
const NO_WEBGL = 'WebGL is unavailable: showing images rendered by the server, 5 per second, from a fixed view. The ' +
  'keyboard still moves the robot.';

// Without WebGL: images rendered by the server. At most one request at a time.
export class Picture {
  private readonly done = () => (this.loading = false);
  private readonly image = element('img', { alt: ALT, load: this.done, error: this.done });
  readonly root = element('figure.picture', this.image, element('figcaption', NO_WEBGL));
  private asked = 0;
  private loading = false;

  tick(now: number): void {
    if (this.loading || now - this.asked < EVERY) return;
    const { clientWidth, clientHeight } = this.root;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.asked = now;
    this.loading = true;
    const scale = Math.min(1, 1280 / clientWidth);
    const size = [clientWidth, clientHeight].map((pixels) => Math.round(scale * pixels));
    this.image.src = `/frame.png?width=${size[0]}&height=${size[1]}&n=${Math.round(now)}`;
  }
}
