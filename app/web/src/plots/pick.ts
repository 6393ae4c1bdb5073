// A plot of whatever quantity is asked for.
import type { Run } from '../data/run';
import { element } from '../ui/dom';
import type { Player } from '../ui/player';
import { screenUnit } from './panels';
import { Plot } from './plot';

export class Pick {
  readonly root = element('section', { class: 'pick' });
  private plot: Plot | null = null;

  constructor(
    private readonly run: Run,
    private readonly player: Player,
  ) {
    const choice = element('select', { 'aria-label': 'any other quantity' });
    choice.append(element('option', { value: '' }, 'any other quantity …'));
    run.channels.forEach((channel, i) => {
      const unit = screenUnit(channel.unit).unit;
      const words = `${channel.name} [${unit}]`;
      choice.append(element('option', { value: String(i) }, words));
    });
    choice.addEventListener('change', () => this.choose(choice.value));
    this.root.append(choice);
  }

  draw(): void {
    this.plot?.draw();
  }
  move(): void {
    this.plot?.move();
  }

  private choose(value: string): void {
    this.plot?.root.remove();
    this.plot = null;
    if (value === '') return;
    const channel = this.run.channels[Number(value)];
    const { unit, factor } = screenUnit(channel.unit);
    const values = channel.values.map((v) => v * factor);
    const curves = [{ name: channel.name, values, color: 0 }];
    this.plot = new Plot({ id: 'pick', title: channel.name, unit, curves }, this.player);
    this.root.append(this.plot.root);
    this.plot.draw();
  }
}
