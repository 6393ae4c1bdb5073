// For a projector: large type, and the whole screen.
import { button, icon } from './dom';
import { remember, remembered } from './preferences';

export function presenterButtons(): HTMLButtonElement[] {
  const show = (isLarge: boolean) => {
    document.body.classList.toggle('large', isLarge);
    type.setAttribute('aria-pressed', String(isLarge));
    remember('large', isLarge);
  };
  const toggle = () => show(!document.body.classList.contains('large'));
  const type = button('A+', 'A+: large type', toggle, 'presenter');
  show(remembered('large', false));
  if (!document.fullscreenEnabled) return [type];
  const fill = () =>
    void (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen());
  return [type, button(icon('full'), 'full screen', fill, 'presenter')];
}
