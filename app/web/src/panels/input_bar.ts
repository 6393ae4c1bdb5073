// The hand: who moves the robot, what the device would push back, who may turn things.
import './input_bar.css';
import { button, changeDetector, element, option, signed } from '../ui/dom';
import {
  type Command, type Frame, type HandState, type SceneMessage, type StateMessage, watches,
} from '../source/link';
import { DEVICE_LIMIT } from '../plot/specs';
import type { LabPage, Panel } from './panel';

const SOURCES: { name: string; words: string; spec?: string }[] = [
  { name: 'scene', words: 'as the scene says' },
  { name: 'drag', words: 'I drag the tip' },
  { name: 'joints', words: 'I drag the joints' },
  { name: 'synthetic', words: 'synthetic hand', spec: 'virtual:synthetic' },
  { name: 'trace', words: 'recorded hand', spec: 'virtual:trace:' }, // and a file
  { name: 'device', words: 'a device …', spec: 'vrpn:Phantom0@localhost' },
];
const MODES: Record<string, string> = {
  live: 'leads the robot',
  held: 'held: the device is silent, the robot stays',
  released: 'released: the springs are slack',
};
const NEAR = 0.8; // of the limit

export class InputBar implements Panel {
  readonly root = element('section.hand-bar', { 'aria-label': 'hand' });
  private readonly source = element('select', { 'aria-label': 'who moves the robot' });
  private readonly spec = element('input', {
    type: 'text',
    'aria-label': 'device, or the file of a recorded hand',
    spellcheck: 'false',
    title: 'as after --device; Enter connects it',
  });
  private readonly facts = element('p.facts');
  private readonly holder = element('div.holder');
  private readonly fill = element('i');
  private readonly force = element(
    'div.force',
    { role: 'meter', 'aria-valuemin': '0', 'aria-valuemax': String(DEVICE_LIMIT) },
    { 'aria-label': 'force of the hand device in newtons' },
    this.fill,
    element('i.mark'),
  );
  private readonly number = element('output.newtons', { 'aria-live': 'off' });
  private readonly warning = element('div.warning');
  private readonly grip = button('', 'gripper (g)', () => this.page.hand.button(0, !this.page.hand.grip));
  private column = -1;
  private newest: Frame | null = null;
  private drawn = '';
  private readonly isNewHolder = changeDetector();
  private choosing = false; // a device whose name is being typed

  constructor(private readonly page: LabPage) {
    this.source.append(...SOURCES.map(({ name, words }) => option(name, words)));
    this.source.addEventListener('change', () => this.choose(this.source.value));
    this.spec.hidden = true;
    this.spec.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.sendSpec(this.spec.value.trim());
      else if (event.key === 'Escape') this.choosing = this.spec.hidden = false;
      event.stopPropagation();
    });
    this.root.append(
      element('div.line', element('b', 'Hand'), this.source, this.grip),
      this.spec,
      element('div.line', this.force, this.number),
      this.warning,
      this.facts,
      this.holder,
    );
  }

  // The size of the device's force, where the scene has it.
  onScene({ channels }: SceneMessage): void {
    this.column = channels.findIndex(({ kind, unit }) => kind === 'hand' && unit === 'N');
  }

  onState(state: StateMessage): void {
    const { hand } = state;
    const leads = hand.source !== '';
    const isWatching = watches(state);
    if (!this.choosing) this.source.value = leads ? chosen(hand) : 'scene';
    this.source.disabled = isWatching || !leads;
    this.grip.disabled = isWatching;
    this.grip.hidden = !leads;
    this.grip.setAttribute('aria-pressed', String(hand.gripper));
    this.grip.textContent = hand.gripper ? 'grips' : 'grip';
    const felt = hand.source === 'device' && hand.felt;
    const words = [`${hand.mapping} mapping`, felt, MODES[hand.mode] ?? hand.mode].filter((word) => word);
    const text = leads ? words.join(' · ') : 'No hand leads this scene. Pull at a body.';
    if (this.facts.textContent !== text) this.facts.textContent = text;
    this.showHolder(state);
  }

  onFrame(frame: Frame): void {
    this.newest = frame;
  }

  draw(): void {
    const force = this.newest && this.column >= 0 ? this.newest.channels[this.column] : NaN;
    const hasForce = Number.isFinite(force);
    const text = hasForce ? `${force.toFixed(2)} N` : '';
    if (text === this.drawn) return;
    this.drawn = text;
    this.force.parentElement!.hidden = !hasForce;
    if (!hasForce) return;
    const share = force / DEVICE_LIMIT;
    const state = share >= 0.999 ? 'beyond' : share > NEAR ? 'near' : 'ok';
    this.fill.style.width = `${Math.min(1, share) * 100}%`;
    this.number.textContent = `${text} of ${DEVICE_LIMIT}`;
    this.force.setAttribute('aria-valuenow', force.toFixed(2));
    if (this.force.dataset.state === state) return;
    this.force.dataset.state = state;
    const limit = `the device gives ${DEVICE_LIMIT} N at most`;
    this.warning.replaceChildren(...(state === 'ok' ? [] : [signed(state, limit)]));
  }

  private choose(name: string): void {
    const source = SOURCES.find((one) => one.name === name);
    if (!source) return;
    const asks = name === 'device' || name === 'trace';
    this.choosing = asks;
    this.spec.hidden = !asks;
    if (asks) {
      const file = name === 'trace' ? (this.page.state?.hand.trace ?? '') : '';
      this.spec.value = source.spec! + file;
      this.spec.focus();
      this.spec.select();
    } else if (source.spec) this.sendSpec(source.spec);
    else this.page.send({ do: 'hand', source: name as 'scene' | 'drag' | 'joints' });
  }

  private sendSpec(spec: string): void {
    this.choosing = false;
    this.spec.hidden = true;
    this.page.send({ do: 'hand', source: 'device', spec });
  }

  // With one page open there is nothing to say.
  private showHolder({ you, holder, clients, asked }: StateMessage): void {
    if (!this.isNewHolder(you, holder, clients, asked)) return;
    const parts: Node[] = [];
    const say = (words: string) => parts.push(element('span', words));
    const offer = (words: string, title: string, command: Command) =>
      parts.push(button(words, title, () => this.page.send(command)));
    const isAlone = clients < 2;
    if (!holder && !isAlone) {
      say('Nobody holds the hand.');
      offer('Take it', 'to move the robot', { do: 'take' });
    } else if (holder && holder !== you) {
      const isAsking = asked.includes(you);
      say(isAsking ? 'You have asked for the hand.' : 'Somebody else holds the hand.');
      if (!isAsking) offer('Ask for it', 'the holder is asked', { do: 'take' });
    } else if (!isAlone) say(`You hold the hand; ${clients - 1} watch${clients === 2 ? 'es' : ''}.`);
    for (const to of holder === you ? asked.filter((client) => client !== you) : [])
      offer(`Give to ${to}`, `page ${to} asks for the hand`, { do: 'give', to });
    this.holder.replaceChildren(...parts);
  }
}

// Which of SOURCES a hand is.
export function chosen({ source, spec }: HandState): string {
  if (source !== 'device') return source;
  return SOURCES.find((one) => one.spec && spec.startsWith(one.spec))?.name ?? 'device';
}
