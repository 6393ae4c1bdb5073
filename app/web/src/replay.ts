// The page of a recorded run: one clock, and all that follows it.
import 'uplot/dist/uPlot.min.css';
import './style.css';
import { channelOf, type Run } from './data/run';
import { panelsOf } from './plots/panels';
import { Pick } from './plots/pick';
import { Plot } from './plots/plot';
import { button, element, icon } from './ui/dom';
import { help, listen, type Key } from './ui/keys';
import { LayerChoice } from './ui/layers';
import { onPaper, PAPER } from './ui/paper';
import { Player } from './ui/player';
import { start } from './ui/start';
import { LedgerTable, MomentumTable, setup } from './ui/tables';
import { Tabs } from './ui/tabs';
import { Theme } from './ui/theme';
import { Transport } from './ui/transport';
import { Labels } from './view/labels';
import { Stage, type ViewName } from './view/stage';

class Page {
  private readonly player: Player;
  private readonly stage: Stage;
  private readonly layers: LayerChoice;
  private readonly labels: Labels;
  private readonly plots: Plot[];
  private readonly pick: Pick;
  private readonly ledgers: (LedgerTable | MomentumTable)[];
  private readonly theme: Theme;
  private readonly tabs = new Tabs();
  private readonly followed = element('select', { title: 'what the camera follows (f)' });
  private readonly host = element('div', { class: 'stage' });
  private stale = true; // the picture
  private numbersStale = true; // what the panel shows
  private numbersAt = 0; // [ms]

  constructor(private readonly run: Run) {
    this.player = new Player(run.times);
    this.theme = new Theme(() => this.recolor());
    this.layers = new LayerChoice(run.layers, () => this.moved());
    this.plots = panelsOf(run).map((spec) => new Plot(spec, this.player));
    this.pick = new Pick(run, this.player);
    this.ledgers = [new LedgerTable(run, this.player), new MomentumTable(run, this.player)];
    this.tabs.add('Plots', ...this.plots.map((plot) => plot.root), this.pick.root);
    this.tabs.add('Ledger', ...this.ledgers.map((ledger) => ledger.root));
    this.tabs.add('Setup', setup(run));
    this.build();
    this.stage = new Stage(this.host, run.view, run, () => (this.stale = true));
    this.labels = new Labels(this.host.querySelector('.labels')!);
    this.player.watch(() => this.moved());
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
    const dialog = help(keys);
    const views = (['start', 'front', 'side', 'top'] as ViewName[]).map((name) =>
      button(name === 'start' ? 'fit' : name, `look from: ${name}`, () => this.look(name)),
    );
    this.followed.append(element('option', { value: '' }, 'camera: free'));
    for (const body of run.bodies)
      this.followed.append(element('option', { value: body }, `on ${body}`));
    this.followed.addEventListener('change', () => {
      this.stage.follow(null);
      this.moved();
    });
    this.host.append(
      element('div', { class: 'labels', 'aria-hidden': 'true' }),
      this.layers.switches,
      this.layers.legend,
      element('div', { class: 'views' }, ...views, this.followed),
      element('div', { class: 'scale' }, gridWords(run)),
    );
    document.body.append(
      element(
        'header',
        {},
        element('h1', {}, run.title),
        element('p', {}, ...headline(run)),
        button('?', 'keys (?)', () => dialog.showModal()),
        button(icon('theme'), 'light or dark (t)', () => this.theme.set(!this.theme.dark)),
      ),
      element('main', {}, this.host, this.tabs.root),
      new Transport(this.player).root,
      dialog,
    );
    listen(keys);
    const help_ = keys.find((key) => key.shown === '?');
    if (help_) help_.act = () => (dialog.open ? dialog.close() : dialog.showModal());
  }

  private keys(): Key[] {
    const { player } = this;
    const step = (count: number) => (event: KeyboardEvent) =>
      player.step(event.shiftKey ? 10 * count : count);
    const key = (keys: string[], shown: string, what: string, act: Key['act']): Key => ({
      keys,
      shown,
      what,
      act,
    });
    const orbit = (around: number, up: number, closer: number) => () => {
      this.stage.orbit(around, up, closer);
      this.stale = true;
    };
    return [
      key([' ', 'k'], 'space', 'play, pause', () => player.toggle()),
      key(['ArrowLeft'], '←', 'one frame back; with shift ten', step(-1)),
      key(['ArrowRight'], '→', 'one frame on; with shift ten', step(1)),
      key(['Home'], 'Home', 'to the start', () => player.seek(player.start)),
      key(['End'], 'End', 'to the end', () => player.seek(player.end)),
      key(['['], '[', 'slower', () => player.changeSpeed(-1)),
      key([']'], ']', 'faster', () => player.changeSpeed(1)),
      ...[1, 2, 3, 4, 5, 6, 7, 8, 9].map((n) =>
        key([String(n)], n === 1 ? '1 – 9' : '', 'show or hide a layer', () =>
          this.layers.toggleNumber(n),
        ),
      ),
      key(['a'], 'a, d', 'turn the view', orbit(-0.1, 0, 1)),
      key(['d'], '', '', orbit(0.1, 0, 1)),
      key(['w'], 'w, s', 'from above, from below', orbit(0, 0.08, 1)),
      key(['s'], '', '', orbit(0, -0.08, 1)),
      key(['+', '='], '+, −', 'nearer, farther', orbit(0, 0, 0.88)),
      key(['-'], '', '', orbit(0, 0, 1 / 0.88)),
      key(['r'], 'r', 'the view of the start', () => this.look('start')),
      key(['f'], 'f', 'follow the next body', () => this.followNext()),
      key(['p', 'l', 'u'], 'p, l, u', 'plots, ledger, setup', (event) =>
        this.tabs.show('plu'.indexOf(event.key)),
      ),
      key(['t'], 't', 'light or dark', () => this.theme.set(!this.theme.dark)),
      key(['?'], '?', 'this help', () => undefined),
    ];
  }

  private look(name: ViewName): void {
    this.followed.value = '';
    this.stage.look(name);
    this.moved();
  }

  private followNext(): void {
    this.followed.selectedIndex = (this.followed.selectedIndex + 1) % this.followed.length;
    this.stage.follow(null);
    this.moved();
  }

  private moved(): void {
    this.stale = this.numbersStale = true;
  }

  private recolor(): void {
    this.stage?.setTheme(this.theme.dark);
    for (const plot of [...this.plots, this.pick]) plot.draw();
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
    if (this.stale) {
      this.stale = false;
      this.paint();
    }
    // Numbers that run faster cannot be read.
    if (this.numbersStale && now - this.numbersAt > (this.player.playing ? 60 : 0)) {
      this.numbersStale = false;
      this.numbersAt = now;
      for (const plot of [...this.plots, this.pick]) plot.move();
      for (const ledger of this.ledgers) ledger.show();
    }
    requestAnimationFrame((next) => this.tick(next));
  }

  private paint(): void {
    const { player, run } = this;
    const frame = player.frame;
    const next = Math.min(frame + 1, run.times.length - 1);
    const shown = this.layers.shown;
    const body = this.followed.value;
    if (body) {
      this.stage.follow(this.placeOf(body, frame, next));
      this.stale = false; // that moved the camera, and is drawn now
    }
    this.stage.paint(
      shown.map((layer) => ({
        columns: layer.instances,
        a: frame,
        b: next,
        share: player.share,
        shadow: layer.name === 'bodies',
      })),
    );
    this.stage.draw();
    this.labels.paint(
      this.stage,
      run.texts,
      shown.map((layer) => ({ columns: layer.labels, frame })),
    );
  }

  private print(isPaper: boolean): void {
    this.stage.resize();
    this.paint();
    for (const plot of this.plots) plot.fit(isPaper ? PAPER : undefined);
  }

  private placeOf(body: string, a: number, b: number): [number, number, number] {
    const at = (axis: string) => {
      const values = channelOf(this.run, `links/${body}/${axis}`)!.values;
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

function headline(run: Run): string[] {
  // All digits stand below Setup.
  const rounded = (text: string) => text.replace(/^[\d.]+/, (digits) => String(+(+digits).toPrecision(4)));
  const fact = (name: string) => {
    const found = run.facts.find(([key]) => key === name)?.[1];
    return found && rounded(found);
  };
  const words = [fact('integrator'), fact('step'), fact('duration')].filter((word) => word);
  return [words.join(' · ')];
}

start<Run>((run) => ({ run, page: new Page(run) }));
