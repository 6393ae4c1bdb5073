// Slider with marks. Positions are 0 to 1.
import './slider.css';
import { element } from './dom';

const STEPS = 10_000;

export class Slider {
  readonly input: HTMLInputElement;
  readonly root: HTMLElement;
  isHeld = false; // by a pointer

  constructor(label: string, slide: (place: number) => void, ...marks: Node[]) {
    this.input = element('input', { type: 'range', min: '0', max: String(STEPS), 'aria-label': label });
    this.root = element('div.track', this.input, ...marks);
    this.input.addEventListener('pointerdown', () => (this.isHeld = true));
    for (const end of ['pointerup', 'pointercancel', 'change', 'blur'])
      this.input.addEventListener(end, () => (this.isHeld = false));
    this.input.addEventListener('input', () => slide(Number(this.input.value) / STEPS));
  }

  put(place: number): void {
    this.input.value = String(STEPS * place);
  }
  // `words`: for screen readers.
  fill(place: number, words: string): void {
    this.input.style.setProperty('--share', `${100 * place}%`);
    this.input.setAttribute('aria-valuetext', words);
  }
}

// null: hides the mark.
export function putMark(mark: HTMLElement, place: number | null): void {
  mark.hidden = place === null || place < 0 || place > 1;
  mark.style.setProperty('--place', String(place ?? 0));
}
