// The pointer on a plot: a click seeks, as does the marker when it is dragged. uPlot has the others:
// a drag zooms, a double click shows all.
import type uPlot from 'uplot';

const NEAR = 7; // pixels from the marker: it is held
const MOVED = 5; // pixels: no click
const DOUBLE = 250; // until a click is none of two [ms]

export class Gestures {
  isHeld = false; // the marker

  constructor(
    canvas: HTMLElement,
    chart: () => uPlot | null,
    marker: () => number | null, // its time
    seek: (time: number) => void,
  ) {
    let from = 0; // where the pointer went down
    let click = 0;
    const seekAt = ({ clientX }: MouseEvent) => {
      const plot = chart();
      if (plot) seek(plot.posToVal(clientX - plot.over.getBoundingClientRect().left, 'x'));
    };
    canvas.addEventListener('pointerdown', (event) => {
      const plot = chart();
      const at = marker();
      from = event.clientX;
      if (!plot || event.button !== 0 || at === null) return;
      const place = plot.over.getBoundingClientRect().left + plot.valToPos(at, 'x');
      this.isHeld = Math.abs(from - place) < NEAR;
      if (this.isHeld) canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => this.isHeld && seekAt(event));
    for (const end of ['pointerup', 'pointercancel'] as const)
      canvas.addEventListener(end, () => (this.isHeld = false));
    canvas.addEventListener('click', (event) => {
      clearTimeout(click);
      if (event.detail > 1 || Math.abs(event.clientX - from) > MOVED) return;
      click = setTimeout(() => seekAt(event), DOUBLE);
    });
  }
}
