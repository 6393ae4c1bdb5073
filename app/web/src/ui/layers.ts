// Which layers are shown, and what their colours mean.
import type { Layer } from '../data/run';
import { element } from './dom';

export class LayerChoice {
  readonly switches = element('fieldset', { class: 'switches' }, element('legend', {}, 'Show'));
  readonly legend = element('ul', { class: 'legend', 'aria-label': 'what the colours mean' });
  private readonly boxes = new Map<string, HTMLInputElement>();

  constructor(
    private readonly layers: Layer[],
    private readonly changed: () => void,
  ) {
    // The bodies themselves are always there; what never has an entry needs no switch.
    const choice = layers.filter((layer) => layer.name !== 'bodies' && hasEntries(layer));
    choice.forEach((layer, i) => this.addSwitch(layer, i < 9 ? String(i + 1) : ''));
    this.fillLegend();
  }

  get shown(): Layer[] {
    return this.layers.filter((layer) => layer.name === 'bodies' || layer.shown);
  }

  set(name: string, shown: boolean): void {
    const layer = this.layers.find((l) => l.name === name);
    const box = this.boxes.get(name);
    if (!layer || !box) return;
    layer.shown = box.checked = shown;
    this.fillLegend();
    this.changed();
  }

  toggleNumber(number: number): void {
    const name = [...this.boxes.keys()][number - 1];
    if (name) this.set(name, !this.boxes.get(name)!.checked);
  }

  private addSwitch(layer: Layer, key: string): void {
    const box = element('input', { type: 'checkbox', 'data-layer': layer.name });
    box.checked = layer.shown;
    box.addEventListener('change', () => this.set(layer.name, box.checked));
    this.boxes.set(layer.name, box);
    const words = element('span', {}, layer.name);
    const label = element('label', { title: layer.what }, box, words);
    if (key) label.append(element('kbd', {}, key));
    this.switches.append(label);
  }

  private fillLegend(): void {
    this.legend.replaceChildren();
    for (const layer of this.shown)
      for (const line of layer.legend) {
        const swatch = element('i');
        swatch.style.background = `rgb(${line.color.join(' ')})`;
        this.legend.append(element('li', {}, swatch, line.text));
      }
    this.legend.hidden = this.legend.childElementCount === 0;
  }
}

function hasEntries(layer: Layer): boolean {
  return layer.instances.mesh.length > 0 || layer.labels.text.length > 0;
}
