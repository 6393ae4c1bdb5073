// Input of the target robot: source, device force, control among clients.
import './input_bar.css';
import { button, changeDetector, element, option, setText, statusLine } from '../ui/dom';
import { type Command, type InputState, isViewOnly, type SceneMessage, type StateMessage } from '../source/link';
import { DEVICE_LIMIT } from '../plot/specs';
import type { LabPage, Panel } from './panel';

const SOURCES: { name: string; label: string; spec?: string }[] = [
  { name: 'scene', label: 'scene motion' },
  { name: 'drag', label: 'drag: end effector' },
  { name: 'joints', label: 'drag: joints' },
  { name: 'synthetic', label: 'synthetic motion', spec: 'virtual:synthetic' },
  { name: 'trace', label: 'recorded motion', spec: 'virtual:trace:' }, // and a file
  { name: 'device', label: 'input device …', spec: 'vrpn:Phantom0@localhost' },
];
const MODES: Record<string, string> = {
  live: 'connected',
  held: 'no data from the device: the target robot is held',
  released: 'device lost: the target follows the robot, coupling forces go to 0',
};
const NEAR = 0.8; // of the limit

export class InputBar implements Panel {
  readonly root = element('section.input-bar', { 'aria-label': 'input' });
  private readonly source = element('select', { 'aria-label': 'input source' });
  private readonly spec = element('input', {
    type: 'text',
    'aria-label': 'device, or file of a recorded operator motion',
    spellcheck: 'false',
    title: 'value of --device; Enter connects',
  });
  private readonly facts = element('p.fine');
  private readonly control = element('div.control');
  private readonly force = element('meter', { 'aria-label': 'device force in newtons', optimum: '0' });
  private readonly number = element('output.newtons', { 'aria-live': 'off' });
  private readonly warning = element('div.warning.fine');
  private readonly gripper = button('', 'gripper (g)', () => {
    this.page.operator.button(0, !this.page.operator.isGripperClosed);
  });
  private readonly input = element('div.line', element('b', 'Input'), this.source, this.gripper);
  private column = -1;
  private drawn = '';
  private readonly isControlNew = changeDetector();
  private readonly isStateNew = changeDetector();
  private isEditing = false; // the device

  constructor(private readonly page: LabPage) {
    this.source.append(...SOURCES.map(({ name, label }) => option(name, label)));
    this.source.addEventListener('change', () => this.choose(this.source.value));
    this.force.max = DEVICE_LIMIT;
    this.force.high = NEAR * DEVICE_LIMIT;
    this.spec.hidden = true;
    this.spec.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.sendSpec(this.spec.value.trim());
      else if (event.key === 'Escape') this.isEditing = this.spec.hidden = false;
      event.stopPropagation();
    });
    this.root.append(
      this.input,
      this.spec,
      element('div.line', { hidden: '' }, this.force, this.number),
      this.warning,
      this.facts,
      this.control,
    );
  }

  // Channel of the device force, if there is one.
  onScene({ channels }: SceneMessage): void {
    this.column = channels.findIndex(({ kind, unit }) => kind === 'device' && unit === 'N');
  }

  onState(state: StateMessage): void {
    const { input } = state;
    const hasTarget = input.source !== '';
    const isDisabled = isViewOnly(state);
    if (!this.isEditing) this.source.value = hasTarget ? chosen(input) : 'scene';
    this.source.disabled = this.gripper.disabled = isDisabled;
    this.input.hidden = this.facts.hidden = !hasTarget;
    this.gripper.setAttribute('aria-pressed', String(input.gripper));
    this.gripper.textContent = input.gripper ? 'closed' : 'grip';
    this.gripper.setAttribute('aria-label', input.gripper ? 'gripper closed (g)' : 'grip (g)');
    const device = input.source === 'device' && input.device_name;
    const facts = [`${input.mapping} mapping`, device, MODES[input.mode] ?? input.mode].filter((fact) => fact);
    setText(this.facts, facts.join(' · '));
    this.showControl(state);
    this.root.hidden = !hasTarget && !this.control.hasChildNodes();
  }

  draw(): void {
    const force = this.page.frame?.channels[this.column] ?? NaN;
    const hasForce = Number.isFinite(force);
    const text = hasForce ? `${force.toFixed(2)} N` : '';
    if (text === this.drawn) return;
    this.drawn = text;
    this.force.parentElement!.hidden = !hasForce;
    if (!hasForce) return;
    const share = force / DEVICE_LIMIT;
    const state = share >= 0.999 ? 'beyond' : share > NEAR ? 'near' : 'ok';
    this.force.value = force;
    this.number.textContent = `${text} of ${DEVICE_LIMIT}`;
    if (!this.isStateNew(state)) return;
    const limit = `maximum force of the device: ${DEVICE_LIMIT} N`;
    this.warning.replaceChildren(...(state === 'ok' ? [] : [statusLine(state, limit)]));
  }

  private choose(name: string): void {
    const { spec } = SOURCES.find((one) => one.name === name)!;
    this.isEditing = name === 'device' || name === 'trace';
    this.spec.hidden = !this.isEditing;
    if (this.isEditing) {
      const file = name === 'trace' ? (this.page.state?.input.trace ?? '') : '';
      this.spec.value = spec! + file;
      this.spec.focus();
      this.spec.select();
    } else if (spec) this.sendSpec(spec);
    else this.page.send({ do: 'input', source: name as 'scene' | 'drag' | 'joints' });
  }

  private sendSpec(spec: string): void {
    this.isEditing = false;
    this.spec.hidden = true;
    this.page.send({ do: 'input', source: 'device', spec });
  }

  // Empty for a single client.
  private showControl({ you, controller, clients, control_requests }: StateMessage): void {
    if (!this.isControlNew(you, controller, clients, control_requests)) return;
    const parts: Node[] = [];
    const show = (text: string) => parts.push(element('span', text));
    const offer = (label: string, title: string, command: Command) =>
      parts.push(button(label, title, () => this.page.send(command)));
    const isAlone = clients < 2;
    if (!controller && !isAlone) {
      show('No client has control.');
      offer('Take control', 'to move the robot', { do: 'request_control' });
    } else if (controller && controller !== you) {
      const isRequested = control_requests.includes(you);
      show(isRequested ? 'Control requested.' : 'View only: another client has control.');
      if (!isRequested) offer('Request control', 'to move the robot', { do: 'request_control' });
    } else if (!isAlone) show(`You have control; ${clients - 1} view only.`);
    for (const to of controller === you ? control_requests.filter((client) => client !== you) : [])
      offer(`Give to ${to}`, `client ${to} requests control`, { do: 'grant_control', to });
    this.control.replaceChildren(...parts);
  }
}

// Name in SOURCES of the current input.
export function chosen({ source, spec }: InputState): string {
  if (source !== 'device') return source;
  return SOURCES.find((one) => one.spec && spec.startsWith(one.spec))?.name ?? 'device';
}
