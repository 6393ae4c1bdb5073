// Printing: picture and plots take the size of a page before the browser looks at them. What WebGL
// has drawn is gone by then, so a copy lies on it.
import { element } from '../ui/dom';

export const PAPER = 680; // pixels of a page's width, as style.css has it

export function onPaper(host: HTMLElement, paint: (isPaper: boolean) => void): void {
  const copy = element('canvas');
  addEventListener('beforeprint', () => {
    host.classList.add('paper');
    paint(true);
    const canvas = host.querySelector('canvas')!;
    copy.width = canvas.width;
    copy.height = canvas.height;
    copy.style.width = canvas.style.width;
    copy.style.height = canvas.style.height;
    copy.getContext('2d')!.drawImage(canvas, 0, 0);
    canvas.after(copy);
  });
  addEventListener('afterprint', () => {
    copy.remove();
    host.classList.remove('paper');
    paint(false);
  });
}
