// Where a browser cannot draw: the program's own picture, five times a second. Never more than one
// on its way.
import { element } from '../ui/dom';

const EVERY = 200; // [ms]

export class Picture {
  readonly root: HTMLElement;
  private readonly image = element('img', { alt: 'the robot, drawn by the program' });
  private asked = 0;
  private loading = false;

  constructor() {
    const words =
      'This browser cannot draw in three dimensions (WebGL): the program draws, five pictures a ' +
      'second, from one side. Keys move the hand all the same.';
    this.root = element('figure.picture', this.image, element('figcaption', words));
    for (const end of ['load', 'error']) this.image.addEventListener(end, () => (this.loading = false));
  }

  tick(now: number): void {
    if (this.loading || now - this.asked < EVERY) return;
    const { clientWidth, clientHeight } = this.root;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.asked = now;
    this.loading = true;
    const scale = Math.min(1, 1280 / clientWidth);
    const size = [clientWidth, clientHeight].map((pixels) => Math.round(scale * pixels));
    this.image.src = `/frame.png?width=${size[0]}&height=${size[1]}&n=${Math.round(now)}`;
  }
}
