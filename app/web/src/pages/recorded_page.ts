// Base of the pages with embedded data: 3-D view with overlays and labels, theme, keys, printing.
import '../ui/style.css';
import type { PageData, Layer } from '../protocol/run';
import { element } from '../ui/dom';
import { help, type Key, listen, pageHeader, viewKeys } from '../ui/keys';
import { Tabs } from '../ui/choices';
import { Theme } from '../ui/preferences';
import { Overlays, Views } from '../view/view_options';
import type { Part } from '../view/painter';
import { Stage, type ViewName } from '../view/stage';
import './print.css';

export type Instant = Pick<Part, 'a' | 'b' | 'share'>; // of all layers

export abstract class RecordedPage {
  protected readonly overlays: Overlays;
  readonly stage: Stage;
  readonly theme = new Theme(() => this.recolor());
  protected readonly tabs = new Tabs();
  protected readonly views = new Views((name) => this.look(name), () => {
    this.stage.follow(null);
    this.touch();
  });
  private stale = true; // the 3-D view

  constructor(private readonly data: PageData, private readonly layers = data.layers, hasNumbers = true) {
    const host = element('div.stage');
    const isUsed = ({ instances, labels }: Layer) => instances.mesh.length > 0 || labels.text.length > 0;
    const shown = layers.filter((layer) => layer.shown).map(({ name }) => name);
    this.overlays = new Overlays(new Set(shown), () => this.touch(), hasNumbers);
    this.overlays.show(layers.filter(isUsed));
    host.append(this.overlays.root, this.views.root);
    document.body.append(element('main', host, this.tabs.root));
    this.stage = new Stage(host, data.view, data, () => this.touch());
    onPaper(host, (isPaper) => {
      this.stage.resize();
      this.paint();
      this.print(isPaper);
    });
  }

  // Adds header, footer and keys, and starts drawing.
  protected begin(title: Node[], foot: Node, keys: Key[], mouse: string): void {
    const dialog = help(keys, mouse);
    document.body.prepend(pageHeader(title, dialog, () => this.theme.toggle()));
    document.body.append(foot, dialog);
    listen(keys);
    const theme = this.hashValue('theme');
    if (theme) this.theme.set(theme === 'dark');
    this.recolor();
    const tick = (now: number) => {
      this.tick(now);
      if (this.stale) this.paint();
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  // Of an address that ends in "#t=1.5&theme=dark".
  protected hashValue(name: string): string | null {
    return new URLSearchParams(location.hash.slice(1)).get(name);
  }

  protected get shownLayers(): Layer[] {
    return this.layers.filter(({ name }) => this.overlays.isShown(name));
  }

  protected viewKeys(followNext?: () => void): Key[] {
    return viewKeys({
      orbit: (...by) => this.stage.orbit(...by),
      look: (name) => this.look(name),
      followNext,
      overlays: this.overlays,
      toggleTheme: () => this.theme.toggle(),
    });
  }

  protected look(name: ViewName): void {
    this.views.body = null;
    this.stage.look(name);
  }
  protected touch(): void {
    this.stale = true;
  }

  private paint(): void {
    const instant = this.before();
    this.stale = false; // a move of the camera by before() is drawn now
    const shown = this.shownLayers;
    this.stage.draw(this.parts(shown, instant));
    const labels = shown.map((layer) => ({ columns: layer.labels, frame: instant.a }));
    this.stage.labels.paint(this.stage.project, this.data.texts, labels);
  }

  // The instant to draw; moves the camera to the body that it follows.
  protected abstract before(): Instant;
  protected parts(shown: Layer[], instant: Instant): Part[] {
    return shown.map(({ name, instances }) => ({ ...instant, columns: instances, shadow: name === 'bodies' }));
  }
  protected tick(_now: number): void {}
  protected print(_isPaper: boolean): void {}
  protected recolor(): void {
    this.stage.setTheme(this.theme.dark);
    this.touch();
  }
}

export const PAPER = 680; // width when printed, in pixels, as in print.css

// Before printing, view and plots take the size of the paper. The WebGL canvas is blank by the time the
// browser prints it, so a copy is laid over it.
function onPaper(host: HTMLElement, paint: (isPaper: boolean) => void): void {
  const copy = element('canvas');
  addEventListener('beforeprint', () => {
    host.classList.add('paper');
    paint(true);
    const canvas = host.querySelector('canvas')!;
    [copy.width, copy.height] = [canvas.width, canvas.height];
    copy.style.cssText = canvas.style.cssText;
    copy.getContext('2d')!.drawImage(canvas, 0, 0);
    canvas.after(copy);
  });
  addEventListener('afterprint', () => {
    copy.remove();
    host.classList.remove('paper');
    paint(false);
  });
}
