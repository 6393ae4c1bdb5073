// The lab's page: connects socket, 3-D view, input and panels. Once per picture it takes the newest message
// of each kind.
import '../ui/style.css';
import { Address } from './address';
import { Inspector } from '../inspector/inspector';
import { Controller } from '../input/gamepad';
import { Drag } from '../input/drag';
import { Operator } from '../input/operator';
import { Handles } from '../input/handles';
import { KeyInput } from '../input/key_input';
import { isKept, labKeys, MOUSE } from './lab_keys';
import * as wire from '../source/link';
import { EnergyPanel } from '../panels/balances';
import { BuildMenu } from '../panels/build_menu';
import { Diverged } from '../panels/diverged';
import { Gallery } from '../panels/gallery';
import { InputBar } from '../panels/input_bar';
import { LabTimeBar } from '../panels/lab_time_bar';
import { Notes } from '../panels/menus';
import { Parameters } from '../panels/parameters';
import { Plots } from '../plot/plots';
import { LiveStage, Picture } from '../view/live_stage';
import { presenterButtons, remember, remembered, Theme } from '../ui/preferences';
import { Overlays, Views } from '../view/view_options';
import type { LabPage, Listener, Panel } from '../panels/panel';
import { Pace } from '../view/pace';
import { Hints } from '../panels/hints';
import { button, element, icon } from '../ui/dom';
import { LiveRun } from '../source/run_source';
import { help, listen, pageHeader, PLOTS } from '../ui/keys';
import { Tabs } from '../ui/choices';
import type { Arrow } from '../view/arrows';
import type { ViewName } from '../view/stage';

import './lab.css'; // last: overrides for touch screens

const TABS = ['Parameters', 'Plots', 'Inspector', 'Energy'];
const DEFAULT_LAYERS = ['targets', 'device', 'couplings', 'contacts', 'device-force', 'earlier-run'];
const NO_CONTROL = new Set(['layers', 'inspect', 'request_control']); // commands that need no control

export class Page implements LabPage {
  scene: wire.SceneMessage | null = null;
  state: wire.StateMessage | null = null;
  frame: wire.Frame | null = null;
  selected: number | null = null;
  readonly pace = new Pace();
  private readonly hints = new Hints();
  private readonly title = element('h1', 'twinarm lab');
  private readonly file = element('p');
  private readonly over = element('div.handles');
  private readonly host = element('div.stage', this.over);
  private readonly tabs = new Tabs();
  private readonly theme = new Theme(() => this.recolor());
  private readonly address = new Address();
  private readonly layers = new Set(this.address.layers ?? remembered('layers', DEFAULT_LAYERS));
  readonly overlays = new Overlays(this.layers, () => this.sendLayers());
  readonly views = new Views((name) => this.look(name), () => this.touch());
  readonly live = new LiveStage(this.host, this.over, () => this.touch(), this.hints.look);
  private readonly picture = this.live.canDraw ? null : new Picture();
  readonly link = new wire.Link(socketAddress(), (open) => this.connected(open));
  readonly operator = new Operator(this.link, () => this.state, (text) => this.showMessage(text));
  private readonly controller = new Controller(this.operator, (text) => this.showMessage(text));
  private readonly handles = new Handles(this.over);
  private readonly view = () => {
    const { scene, frame } = this;
    return scene && frame ? { scene, frame, stage: this.live.stage } : null;
  };
  readonly drag: Drag = new Drag(this.host, this.view, this.operator, this.handles, {
    select: (body) => this.select(body),
    changed: () => this.touch(),
  });
  readonly keys = new KeyInput(
    this.view,
    this.operator,
    this.handles,
    (view, joint) => this.drag.jointValue(view, joint),
    () => this.touch(),
  );
  private readonly run = new LiveRun(this);
  readonly set = this.panelsBut(this.run);
  private readonly inspector = new Inspector(this);
  private readonly panels: Panel[] = [...Object.values(this.set), this.inspector];
  private readonly listeners: Listener[] = [this.run, ...this.panels]; // the run first: panels read it
  private stale = true;
  private paintedAt = 0; // [ms]

  constructor() {
    const { parameters, plots, energy } = this.set;
    [parameters, plots, this.inspector, energy].forEach((panel, i) => this.tabs.add(TABS[i], panel.root));
    this.build();
    const theme = remembered<boolean | null>('dark', null);
    if (theme !== null) this.theme.set(theme);
    this.recolor();
    requestAnimationFrame((now) => this.tick(now));
  }

  send(command: wire.Command): boolean {
    if (!NO_CONTROL.has(command.do) && !this.operator.requestControl()) return false;
    return this.link.send(command);
  }

  select(body: number | null): void {
    if (body === this.selected) return;
    this.selected = body;
    for (const panel of this.panels) panel.onSelect?.(body);
    this.touch();
  }

  showMessage(text: string): void {
    this.hints.showMessage(text);
  }

  arrows(arrows: Arrow[]): void {
    this.live.stage?.arrows.set(arrows);
    this.touch();
  }

  showTab(title: string): void {
    this.fold(false);
    this.tabs.show(Math.max(0, TABS.indexOf(title)));
    for (const panel of this.panels) panel.onTheme?.();
  }

  // All but the inspector: `time` is the bar below the view, `input` in a corner of the view, `gallery` a dialog,
  // `diverged` over the view while the run has diverged.
  private panelsBut(run: LiveRun) {
    const parameters = new Parameters(this);
    const build = new BuildMenu(this);
    const notes = new Notes();
    const time = new LabTimeBar(this, () => parameters.changes, [build.root, notes.root]);
    const [plots, energy, gallery] = [new Plots(run), new EnergyPanel(run), new Gallery(this)];
    const [input, diverged] = [new InputBar(this), new Diverged(this, time.rewind)];
    return { build, notes, parameters, plots, energy, time, input, gallery, diverged };
  }

  private build(): void {
    const { time, input, gallery, diverged } = this.set;
    const { hints } = this;
    const keys = labKeys(this);
    const dialog = help(keys, `${MOUSE} ${PLOTS}`);
    const scenes = button([icon('gallery'), 'Scenes'], 'scenes (e)', () => gallery.root.showModal(), 'labelled');
    const header = pageHeader([this.title, this.file, scenes], dialog, () => this.toggleTheme());
    header.append(...presenterButtons());
    header.append(button(icon('panel'), 'hide or show the panel (\\)', () => this.togglePanel()));
    this.host.append(
      ...(this.picture ? [this.picture.root] : []),
      this.overlays.root,
      this.views.root,
      element('div.foot', hints.look, hints.again, hints.hint, hints.spoken),
      element('div.input-corner', input.root),
      hints.banner,
      diverged.root,
    );
    this.host.addEventListener('pointerdown', ({ target }) => {
      if (target instanceof HTMLCanvasElement || target === this.handles.tip) hints.fold(true);
    });
    document.body.classList.add('lab');
    document.body.append(header, element('main', this.host, time.root, this.tabs.root), gallery.root, dialog);
    listen(keys, isKept);
    this.fold(remembered('folded', false));
  }

  private get folded(): boolean {
    return document.body.classList.contains('folded');
  }
  private fold(folded: boolean): void {
    document.body.classList.toggle('folded', folded);
    remember('folded', folded);
  }

  togglePanel(): void {
    this.fold(!this.folded);
  }
  isTab(title: string): boolean {
    return !this.folded && this.tabs.current === TABS.indexOf(title);
  }

  toggleTheme(): void {
    this.theme.toggle();
    remember('dark', this.theme.dark);
  }

  private recolor(): void {
    this.live.setTheme(this.theme.dark);
    for (const panel of this.panels) panel.onTheme?.();
    this.touch();
  }

  look(name: ViewName): void {
    this.views.body = null;
    this.live.stage?.look(name);
  }

  private touch(): void {
    this.stale = true;
  }

  private connected(open: boolean): void {
    this.hints.connection(open);
    if (open) this.sendLayers();
  }

  private sendLayers(): void {
    remember('layers', [...this.layers]);
    this.link.send({ do: 'layers', names: this.overlays.names });
    this.touch();
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next));
    this.controller.poll();
    this.drag.tick();
    this.operator.flush();
    this.takeNews(this.link.take());
    if (this.stale && this.frame && now - this.paintedAt >= this.live.interval) this.paint(this.frame, now);
    this.picture?.tick(now);
    this.hints.tick(now, (!this.drag.held && this.keys.hint) || this.drag.hint);
    for (const panel of this.panels)
      if (panel.draw && !(panel.root.closest('[hidden]') || (this.folded && panel.root.closest('aside'))))
        panel.draw();
  }

  private takeNews({ scene, state, inspection, frame }: wire.News): void {
    if (scene) this.takeScene(scene);
    if (state) {
      const wasRequested = this.state?.control_requests.includes(this.state.you);
      this.state = state;
      if (wasRequested && this.operator.hasControl) this.showMessage('You have control now.');
      for (const listener of this.listeners) listener.onState?.(state);
      this.address.onState(this);
    }
    if (inspection) { for (const panel of this.panels) panel.onInspection?.(inspection); }
    if (!frame || frame.scene !== this.scene?.scene) return;
    this.frame = frame;
    this.stale = true;
    for (const listener of this.listeners) listener.onFrame?.(frame);
  }

  private takeScene(scene: wire.SceneMessage): void {
    if (scene.scene !== this.scene?.scene) {
      this.frame = null;
      this.select(null);
      this.keys.leave();
    }
    if (!this.scene) performance.mark('scene is here');
    this.scene = scene;
    document.title = `${scene.title} · twinarm lab`;
    this.title.textContent = scene.title;
    this.file.textContent = scene.file;
    this.views.show(scene.bodies);
    this.overlays.show(scene.layers);
    this.hints.show(scene);
    void this.live.show(scene);
    for (const listener of this.listeners) listener.onScene?.(scene);
  }

  private paint(frame: wire.Frame, now: number): void {
    this.live.paint(frame, this.overlays, this.selected, this.views.body);
    this.paintedAt = now;
    this.stale = false; // following a body has moved the camera, which is drawn already
    this.drag.draw(this.keys);
    this.operator.measureDelay(frame);
    if (this.pace.painted(now) && !frame.paused) this.live.coarsen();
    if (this.live.isReady && document.documentElement.dataset.ready !== 'true') {
      document.documentElement.dataset.ready = 'true';
      performance.mark('first frame');
    }
  }
}

function socketAddress(): string {
  const address = new URL('/live', location.href);
  address.protocol = address.protocol.replace('http', 'ws');
  return address.href;
}

// Performance marks for scripts/measure/lab_first_frame.
performance.mark('script runs');
Object.assign(window, { twinarm: { page: new Page() } });
performance.mark('page is built');
