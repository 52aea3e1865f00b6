// The serial ports of the server's computer, and the first contact with a machine on one of them. The server lists ports
// without opening them; it opens one only when a person has agreed to it.
import { computed, signal } from '@preact/signals';
import { attempt } from '../core/notices';
import { get, post } from './api';
import { status } from './connection';
import { beOwner } from './owner';

export interface Port {
  device: string;
  lasting_name: string;
  usb: { vendor: string; product: string; manufacturer: string; product_name: string; serial_number: string };
  users: { process: number | null; program: string }[];
}
interface Ports {
  ports: Port[];
  sees_all_programs: boolean;
  board: string; // that of the server
}
// What `passo machine --from` has made of the board's settings.
export interface NewMachine {
  controller: string;
  machine_file: string;
  understood: { source: string; value: string; target: string }[];
  assumed: { target: string; reason: string }[];
  unmapped: { source: string; value: string; reason: string }[];
  warnings: string[];
}
interface Opened {
  state: 'none' | 'running' | 'done' | 'failed';
  device: string;
  board: string;
  words: string;
  report: NewMachine | null;
}
interface Kept {
  path: string;
  command: string;
}

const lookEvery = 300; // ms, at a port that is being read
const listEvery = 4000; // ms

export const ports = signal<Ports | null>(null);
export const opened = signal<Opened | null>(null);
export const keptMachine = signal<Kept | null>(null);
export const isSimulated = computed(() => ports.value?.board === 'virtual');
// The server does not look for ports while the machine moves.
const mayList = (): boolean => ['Idle', 'Alarm', 'Sleep'].includes(status.value?.state ?? '');

async function learnPorts(): Promise<void> {
  try {
    ports.value = await get<Ports>('/ports');
  } catch {
    // The machine has just begun to move, or the connection is lost: the next look tells.
  }
}

// While a person sees the list, ports come and go in it.
export function watchPorts(): () => void {
  const look = (): void => {
    if (mayList() && document.visibilityState === 'visible') void learnPorts();
  };
  look();
  const timer = setInterval(look, listEvery);
  return () => clearInterval(timer);
}

async function followOpened(): Promise<void> {
  while (opened.value?.state === 'running') {
    await new Promise((resolve) => setTimeout(resolve, lookEvery));
    opened.value = await get<Opened>('/ports/open');
  }
  await learnPorts();
}

export async function needOpened(): Promise<void> {
  if (opened.value !== null) return;
  await attempt(async () => {
    opened.value = await get<Opened>('/ports/open');
    await followOpened();
  });
}

// `device`: of the list; or "tcp:HOST:PORT".
export async function openPort(device: string, baud?: number): Promise<void> {
  await attempt(async () => {
    await beOwner();
    keptMachine.value = null;
    opened.value = await post<Opened>('/ports/open', baud === undefined ? { device } : { device, baud });
    await followOpened();
  });
}

export async function keepMachine(name: string, text: string): Promise<void> {
  await attempt(async () => {
    await beOwner();
    keptMachine.value = await post<Kept>('/machine/files', { name, text });
  });
}

// "2341:0043"
export const idOf = ({ usb }: Port): string => `${usb.vendor}:${usb.product}`;
// What the device calls itself. Many names begin with that of the manufacturer.
export function nameOf({ usb }: Port): string {
  const all = usb.product_name.startsWith(usb.manufacturer) ? [usb.product_name] : [usb.manufacturer, usb.product_name];
  return all.filter((words) => words !== '').join(' ');
}
export const usersOf = ({ users }: Port, unknown: string): string =>
  users.map(({ program, process }) => `${program === '' ? unknown : program}${process === null ? '' : ` (${process})`}`).join(', ');
// A name for the machine's file: of small letters, digits and -.
export const fileNameFor = (words: string): string =>
  `${words.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-+|-+$/g, '').slice(0, 40) || 'machine'}.toml`;
