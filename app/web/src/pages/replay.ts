// The page of a recorded run: one clock, and all that follows it.
import { EnergyPanel } from '../panels/energy';
import { MomentumPanel } from '../panels/momentum';
import type { Panel } from '../panels/panel';
import { setup } from '../panels/setup';
import { TimeBar } from '../panels/time_bar';
import { Plots } from '../plot/plots';
import { channelOf, type Run } from '../protocol/run';
import { Player } from '../source/player';
import { button, element, icon } from '../ui/dom';
import { clockKeys, key, MOUSE, PLOTS, viewKeys, type Key } from '../ui/keys';
import { PAPER } from './paper';
import { RecordedPage, type Instant } from './recorded_page';
import { start } from './start';

const TABS = ['plots', 'ledger', 'setup'];

class Page extends RecordedPage {
  private readonly player: Player;
  private readonly plots: Plots;
  private readonly panels: Panel[];
  private readonly bar: TimeBar;

  constructor(private readonly run: Run) {
    super(run);
    const player = new Player(run, () => this.touch());
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
    this.plots = new Plots(player);
    const balances = [new EnergyPanel(player), new MomentumPanel(run, player)];
    this.panels = [this.plots, ...balances];
    this.tabs.add('Plots', this.plots.root);
    this.tabs.add('Ledger', ...balances.map((panel) => panel.root));
    this.tabs.add('Setup', setup(run));
    this.views.show(run.bodies.map((name) => ({ name, moves: true })));
    this.views.root.after(element('div.scale', gridWords(run)));
    const title = [element('h1', run.title), element('p', headline(run))];
    this.takeHash();
    this.begin(title, this.bar.root, this.keys(), `${MOUSE} ${PLOTS}`);
  }

  // What tests and the curious ask.
  get state() {
    return {
      time: this.player.at,
      frame: this.player.frame,
      playing: this.player.playing,
      layers: this.layers.shown.map((layer) => layer.name),
      eye: this.stage.camera.position.toArray(),
    };
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

  protected recolor(): void {
    super.recolor();
    this.plots.onTheme();
  }

  // "#t=1.5&theme=dark&show=contacts,trails&tab=ledger": a link to a moment.
  private takeHash(): void {
    const time = Number(this.asked('t') ?? NaN);
    if (Number.isFinite(time)) this.player.seek(time);
    const show = this.asked('show')?.split(',');
    if (show) for (const { name } of this.run.layers) this.layers.set(name, show.includes(name));
    const tab = TABS.indexOf(this.asked('tab') ?? '');
    if (tab >= 0) this.tabs.show(tab);
  }

  protected tick(now: number): void {
    this.player.tick(now);
    for (const panel of this.panels) if (!panel.root.closest('[hidden]')) panel.draw?.();
  }

  protected before(): Instant {
    const { run, player } = this;
    const { frame, share, at, start, end, playing, speed } = player;
    const next = Math.min(frame + 1, run.times.length - 1);
    const { body } = this.views;
    if (body !== null) this.stage.follow(this.placeOf(run.bodies[body], frame, next));
    this.bar.show({
      time: at,
      share: (at - start) / Math.max(1e-12, end - start),
      goes: playing,
      speed,
      words: `${at.toFixed(3)} seconds`,
    });
    this.bar.where.textContent = `frame ${frame + 1} of ${run.times.length}`;
    return { a: frame, b: next, share };
  }

  protected print(isPaper: boolean): void {
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
