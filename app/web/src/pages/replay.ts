// The page of a recorded run: one clock, and all that follows it.
import '../ui/style.css';
import { EnergyPanel } from '../panels/energy';
import { MomentumPanel } from '../panels/momentum';
import type { Panel } from '../panels/panel';
import { setup } from '../panels/setup';
import { TimeBar } from '../panels/time_bar';
import { Plots } from '../plot/plots';
import { channelOf, type Run } from '../protocol/run';
import { Player } from '../source/player';
import { button, element, icon } from '../ui/dom';
import { clockKeys, help, key, listen, MOUSE, pageHeader, PLOTS, viewKeys, type Key } from '../ui/keys';
import { Tabs } from '../ui/tabs';
import { Theme } from '../ui/theme';
import { Labels } from '../view/labels';
import { LayerChoice } from '../view/layers';
import { Stage, type ViewName } from '../view/stage';
import { Views } from '../view/views';
import { onPaper, PAPER } from './paper';
import './print.css';
import { start } from './start';

class Page {
  private readonly player: Player;
  private readonly stage: Stage;
  private readonly layers: LayerChoice;
  private readonly labels: Labels;
  private readonly plots: Plots;
  private readonly panels: Panel[];
  private readonly theme: Theme;
  private readonly tabs = new Tabs();
  private readonly bar: TimeBar;
  private readonly views = new Views(
    (name) => this.look(name),
    () => {
      this.stage.follow(null);
      this.touch();
    },
  );
  private readonly host = element('div', { class: 'stage' });
  private stale = true; // the picture

  constructor(private readonly run: Run) {
    const player = new Player(run);
    this.player = player;
    this.bar = new TimeBar(
      player,
      'time in seconds',
      [
        button(icon('first'), 'to the start (Home)', () => player.seek(player.start)),
        button(icon('back'), 'one frame back (←)', () => player.step(-1)),
      ],
      [
        button(icon('on'), 'one frame on (→)', () => player.step(1)),
        button(icon('last'), 'to the end (End)', () => player.seek(player.end)),
      ],
    );
    this.theme = new Theme(() => this.recolor());
    this.layers = new LayerChoice(run.layers, () => this.touch());
    this.plots = new Plots(player);
    const balances = [new EnergyPanel(player), new MomentumPanel(run, player)];
    this.panels = [this.plots, ...balances];
    this.tabs.add('Plots', this.plots.root);
    this.tabs.add('Ledger', ...balances.map((panel) => panel.root));
    this.tabs.add('Setup', setup(run));
    this.views.show(run.bodies.map((name) => ({ name, moves: true })));
    this.build();
    this.stage = new Stage(this.host, run.view, run, () => this.touch());
    this.labels = new Labels(this.host.querySelector('.labels')!);
    player.watch(() => this.touch());
    this.takeHash();
    this.recolor();
    onPaper(this.host, (isPaper) => this.print(isPaper));
    requestAnimationFrame((now) => this.tick(now));
  }

  // What tests and the curious ask.
  get state() {
    return {
      time: this.player.time,
      frame: this.player.frame,
      playing: this.player.playing,
      layers: this.layers.shown.map((layer) => layer.name),
      eye: this.stage.camera.position.toArray(),
    };
  }

  private build(): void {
    const { run } = this;
    const keys = this.keys();
    const dialog = help(keys, `${MOUSE} ${PLOTS}`);
    this.host.append(
      element('div', { class: 'labels', 'aria-hidden': 'true' }),
      this.layers.switches,
      this.layers.legend,
      this.views.root,
      element('div', { class: 'scale' }, gridWords(run)),
    );
    const title = [element('h1', {}, run.title), element('p', {}, headline(run))];
    document.body.append(
      pageHeader(title, dialog, () => this.theme.toggle()),
      element('main', {}, this.host, this.tabs.root),
      this.bar.root,
      dialog,
    );
    listen(keys);
  }

  private keys(): Key[] {
    const { player } = this;
    const step = (count: number) => (event: KeyboardEvent) =>
      player.step(event.shiftKey ? 10 * count : count);
    return [
      ...clockKeys(player),
      key(['ArrowLeft'], '← →', 'one frame back or on; with shift ten', step(-1)),
      key(['ArrowRight'], '', '', step(1)),
      key(['Home'], 'Home', 'to the start', () => player.seek(player.start)),
      key(['End'], 'End', 'to the end', () => player.seek(player.end)),
      ...viewKeys({
        orbit: (...by) => this.stage.orbit(...by),
        look: (name) => this.look(name),
        followNext: () => this.views.next(null),
        toggleLayer: (number) => this.layers.toggleNumber(number),
        toggleTheme: () => this.theme.toggle(),
      }),
      key(['p', 'l', 'u'], 'p, l, u', 'plots, ledger, setup', (event) =>
        this.tabs.show('plu'.indexOf(event.key)),
      ),
    ];
  }

  private look(name: ViewName): void {
    this.views.body = null;
    this.stage.look(name);
  }

  private touch(): void {
    this.stale = true;
  }

  private recolor(): void {
    this.stage?.setTheme(this.theme.dark);
    this.plots.onTheme();
  }

  // "#t=1.5&theme=dark&show=contacts,trails&tab=ledger": a link to a moment.
  private takeHash(): void {
    const asked = new URLSearchParams(location.hash.slice(1));
    const time = Number(asked.get('t') ?? NaN);
    if (Number.isFinite(time)) this.player.seek(time);
    const theme = asked.get('theme');
    if (theme) this.theme.set(theme === 'dark');
    const show = asked.get('show')?.split(',');
    if (show)
      for (const { name } of this.run.layers) this.layers.set(name, show.includes(name));
    const tab = ['plots', 'ledger', 'setup'].indexOf(asked.get('tab') ?? '');
    if (tab >= 0) this.tabs.show(tab);
  }

  private tick(now: number): void {
    this.player.tick(now);
    if (this.stale) this.paint();
    for (const panel of this.panels) if (!panel.root.closest('[hidden]')) panel.draw?.();
    requestAnimationFrame((next) => this.tick(next));
  }

  private paint(): void {
    const { player, run } = this;
    const { frame, share, time } = player;
    const next = Math.min(frame + 1, run.times.length - 1);
    const shown = this.layers.shown;
    const { body } = this.views;
    if (body !== null) this.stage.follow(this.placeOf(run.bodies[body], frame, next));
    this.stale = false; // though that moved the camera: it is drawn now
    this.stage.paint(
      shown.map(({ name, instances }) => ({
        columns: instances,
        a: frame,
        b: next,
        share,
        shadow: name === 'bodies',
      })),
    );
    this.stage.draw();
    const labels = shown.map((layer) => ({ columns: layer.labels, frame }));
    this.labels.paint(this.stage, run.texts, labels);
    this.bar.show({
      time,
      share: (time - player.start) / Math.max(1e-12, player.end - player.start),
      goes: player.playing,
      speed: player.speed,
      words: `${time.toFixed(3)} seconds`,
    });
    this.bar.where.textContent = `frame ${frame + 1} of ${run.times.length}`;
  }

  private print(isPaper: boolean): void {
    this.stage.resize();
    this.paint();
    for (const panel of this.panels) panel.draw?.();
    if (isPaper) this.plots.print(PAPER);
    else this.plots.onTheme();
  }

  private placeOf(body: string, a: number, b: number): [number, number, number] {
    const at = (axis: string) => {
      const { values } = channelOf(this.run, `links/${body}/${axis}`)!;
      return values[a] + this.player.share * (values[b] - values[a]);
    };
    return [at('x'), at('y'), at('z')];
  }
}

function gridWords(run: Run): string {
  const { visible, cell, cellsPerMajor } = run.view.ground;
  const length = (metres: number) => `${+metres.toPrecision(3)} m`;
  return visible ? `grid ${length(cell)}, bold ${length(cell * cellsPerMajor)}` : '';
}

// All digits stand below Setup.
function headline(run: Run): string {
  const rounded = (text: string) => text.replace(/^[\d.]+/, (digits) => String(+(+digits).toPrecision(4)));
  const fact = (name: string) => run.facts.find(([key]) => key === name)?.[1];
  const words = ['integrator', 'step', 'duration'].map(fact).filter((word) => word !== undefined);
  return words.map(rounded).join(' · ');
}

start<Run>((run) => ({ run, page: new Page(run) }));
