// What the pages that carry their data have in common: the picture with its layers, views and
// labels, theme, keys, printing; painted when something has changed.
import '../ui/style.css';
import type { Carried, Layer } from '../protocol/run';
import { element } from '../ui/dom';
import { help, type Key, listen, pageHeader } from '../ui/keys';
import { Tabs } from '../ui/choices';
import { Theme } from '../ui/preferences';
import { LayerChoice, Views } from '../view/view_options';
import type { Part } from '../view/painter';
import { Stage, type ViewName } from '../view/stage';
import './print.css';

export type Instant = Pick<Part, 'a' | 'b' | 'share'>; // of all layers

export abstract class RecordedPage {
  readonly layers: LayerChoice;
  readonly stage: Stage;
  readonly theme = new Theme(() => this.recolor());
  protected readonly tabs = new Tabs();
  protected readonly views = new Views((name) => this.look(name), () => this.release());
  private stale = true; // the picture

  constructor(private readonly carried: Carried, layers = carried.layers) {
    const host = element('div.stage');
    this.layers = new LayerChoice(layers, () => this.touch());
    host.append(this.layers.switches, this.layers.legend, this.views.root);
    document.body.append(element('main', host, this.tabs.root));
    this.stage = new Stage(host, carried.view, carried, () => this.touch());
    onPaper(host, (isPaper) => {
      this.stage.resize();
      this.paint();
      this.print(isPaper);
    });
  }

  // The parts around the picture; then the page goes on by itself.
  protected begin(title: Node[], foot: Node, keys: Key[], mouse: string): void {
    const dialog = help(keys, mouse);
    document.body.prepend(pageHeader(title, dialog, () => this.theme.toggle()));
    document.body.append(foot, dialog);
    listen(keys);
    const theme = this.asked('theme');
    if (theme) this.theme.set(theme === 'dark');
    this.recolor();
    const tick = (now: number) => {
      this.tick(now);
      if (this.stale) this.paint();
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  // "#t=1.5&theme=dark": a link to what is shown.
  protected asked(name: string): string | null {
    return new URLSearchParams(location.hash.slice(1)).get(name);
  }

  protected look(name: ViewName): void {
    this.views.body = null;
    this.stage.look(name);
  }
  private release(): void {
    this.stage.follow(null);
    this.touch();
  }
  protected touch(): void {
    this.stale = true;
  }

  private paint(): void {
    const instant = this.before();
    this.stale = false; // though the camera may have moved: it is drawn now
    const shown = this.layers.shown;
    this.stage.paint(this.parts(shown, instant));
    this.stage.draw();
    const labels = shown.map((layer) => ({ columns: layer.labels, frame: instant.a }));
    this.stage.labels.paint(this.stage, this.carried.texts, labels);
  }

  // Which instant is to be painted; the camera goes along with what it follows.
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

// Printing: picture and plots take the size of a page before the browser looks at them. What WebGL
// has drawn is gone by then, so a copy lies on it.
export const PAPER = 680; // pixels of a page's width, as style.css has it

export function onPaper(host: HTMLElement, paint: (isPaper: boolean) => void): void {
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
