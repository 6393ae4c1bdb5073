// Page of a recorded run.
import { EnergyPanel, MomentumPanel } from '../panels/balances';
import type { Panel } from '../panels/panel';
import { TimeBar } from '../panels/time_bar';
import { Plots } from '../plot/plots';
import type { Run } from '../protocol/run';
import { Player } from '../source/playhead';
import { button, element, icon } from '../ui/dom';
import { clockKeys, key, type Key, MOUSE, PLOTS } from '../ui/keys';
import { type Instant, PAPER, RecordedPage } from './recorded_page';
import { start } from '../source/embedded';
import { row, table, wide } from '../ui/table';

const TABS = ['plots', 'energy', 'setup'];

class Page extends RecordedPage {
  private readonly player = new Player(this.run, () => this.touch());
  private readonly bar = new TimeBar(
    this.player,
    'time in seconds',
    [
      button(icon('first'), 'to the start (Home)', () => this.player.seek(this.player.start)),
      button(icon('back'), 'previous frame (←)', () => this.player.step(-1)),
    ],
    [
      button(icon('on'), 'next frame (→)', () => this.player.step(1)),
      button(icon('last'), 'to the end (End)', () => this.player.seek(this.player.end)),
    ],
  );
  private readonly plots = new Plots(this.player);
  private readonly balances = [new EnergyPanel(this.player), new MomentumPanel(this.run, this.player)];
  private readonly panels: Panel[] = [this.plots, ...this.balances];

  constructor(private readonly run: Run) {
    super(run);
    this.tabs.add('Plots', this.plots.root);
    this.tabs.add('Energy', ...this.balances.map((panel) => panel.root));
    this.tabs.add('Setup', setup(run));
    this.views.show(run.bodies.map((name) => ({ name, moves: true })));
    this.views.root.after(element('div.scale.fine', gridText(run)));
    const title = [element('h1', run.title), element('p', headline(run))];
    this.takeHash();
    this.begin(title, this.bar.root, this.keys(), `${MOUSE} ${PLOTS}`);
  }

  // For tests.
  get state() {
    return {
      time: this.player.at,
      frame: this.player.frame,
      playing: this.player.playing,
      layers: this.shownLayers.map(({ name }) => name),
      eye: this.stage.camera.position.toArray(),
    };
  }

  private keys(): Key[] {
    const { player } = this;
    const step = (count: number) => ({ shiftKey }: KeyboardEvent) => player.step(shiftKey ? 10 * count : count);
    const tab = (number: number) => () => this.tabs.show(number);
    return [
      ...clockKeys(player),
      key('← →', 'previous, next frame; with shift by ten', { ArrowLeft: step(-1), ArrowRight: step(1) }),
      key('Home', 'to the start', () => player.seek(player.start)),
      key('End', 'to the end', () => player.seek(player.end)),
      ...this.viewKeys(() => this.views.next(null)),
      key('p, l, u', 'plots, energy, setup', { p: tab(0), l: tab(1), u: tab(2) }),
    ];
  }

  protected recolor(): void {
    super.recolor();
    this.plots.onTheme();
  }

  // "#t=1.5&theme=dark&show=contacts,trails&tab=energy"
  private takeHash(): void {
    const time = Number(this.hashValue('t') ?? NaN);
    if (Number.isFinite(time)) this.player.seek(time);
    const show = this.hashValue('show')?.split(',');
    if (show) { for (const { name } of this.run.layers) this.overlays.set(name, show.includes(name)); }
    const tab = TABS.indexOf(this.hashValue('tab') ?? '');
    if (tab >= 0) this.tabs.show(tab);
  }

  protected tick(now: number): void {
    this.player.advance(now, this.player.end);
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
      isPlaying: playing,
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
      const { values } = this.run.channels.find(({ name }) => name === `links/${body}/${axis}`)!;
      return values[a] + this.player.share * (values[b] - values[a]);
    };
    return [at('x'), at('y'), at('z')];
  }
}

function gridText(run: Run): string {
  const { visible, cell, cellsPerMajor } = run.view.ground;
  const length = (metres: number) => `${+metres.toPrecision(3)} m`;
  return visible ? `grid ${length(cell)}, bold ${length(cell * cellsPerMajor)}` : '';
}

// Rounded; the Setup tab has all digits.
function headline(run: Run): string {
  const rounded = (text: string) => text.replace(/^[\d.]+/, (digits) => String(+(+digits).toPrecision(4)));
  const fact = (name: string) => run.facts.find(([key]) => key === name)?.[1];
  const facts = ['integrator', 'step', 'duration'].map(fact).filter((text) => text !== undefined);
  return facts.map(rounded).join(' · ');
}

function section(title: string, head: string[], rows: string[][]): HTMLElement {
  const lines = rows.map(([first, ...rest]) => row(first, ...rest.map((text) => element('td', text))));
  return element('section', element('h3', title), wide(title, table(head, lines)));
}

function fold(title: string, text: string): HTMLElement {
  return element('details', element('summary', title), element('pre', { tabindex: '0' }, text));
}

// Settings and input files of the run.
function setup(run: Run): HTMLElement {
  const root = element('section.setup');
  const copy = button('copy', 'copy the command', () => {
    void navigator.clipboard?.writeText(run.command);
  });
  root.append(
    element('h3', 'Command'),
    element('div.command', element('code', { id: 'command' }, run.command), copy),
  );
  for (const note of run.notes) root.append(element('p.note', note));
  const facts = element('dl');
  for (const [name, value] of run.facts)
    facts.append(element('dt', name), element('dd', { 'data-fact': name }, value));
  root.append(facts);
  for (const { title, head, rows } of run.tables) root.append(section(title, head, rows));
  for (const { name, text } of run.files) root.append(fold(name, text));
  const licences = document.getElementById('licences');
  if (licences) root.append(fold('Licences of the libraries in this page', licences.textContent ?? ''));
  return root;
}

start<Run>((run) => ({ run, page: new Page(run) }));
