// The connection: the machine's status, by WebSocket, many times a second. The server gives a sign of life each second,
// so that silence means that the connection is lost: known within 2 s.
import { computed, signal } from '@preact/signals';
import type { Machine, Status } from './api';
import { get, Refused } from './api';
import { ownerKey } from './owner_key';
import { token } from './token';

export type Connection = 'connecting' | 'live' | 'lost' | 'token';

const rate = 30; // messages a second, at most
const silentFor = 1700; // ms
const openWithin = 8000; // ms
const lookEvery = 150; // ms
const retryAfter = 700; // ms

export const connection = signal<Connection>('connecting');
export const status = signal<Status | null>(null);
export const machine = signal<Machine | null>(null);
// performance.now() of the last message
export const heardAt = signal(0);
export const isLive = computed(() => connection.value === 'live');

let socket: WebSocket | undefined;
let openedAt = 0;
let closed = false;

function isStatus(said: unknown): said is Status {
  return typeof said === 'object' && said !== null && 'state' in said && 'place' in said;
}

function hear(text: string): void {
  const said: unknown = JSON.parse(text);
  heardAt.value = performance.now();
  if (!isStatus(said)) return;
  // Who is no owner any more forgets the key. While the key is just being given, the status may be older than the key.
  if (said.owner.kind !== 'client' && status.value?.owner.kind === 'client') ownerKey.value = '';
  status.value = said;
  if (connection.value !== 'live') {
    connection.value = 'live';
    void learnMachine();
  }
}

async function learnMachine(): Promise<void> {
  try {
    machine.value = await get<Machine>('/machine');
  } catch {
    // A busy computer may take too long: without the machine half of the page would be missing.
    if (connection.value === 'live') setTimeout(() => void learnMachine(), retryAfter);
  }
}

function open(): void {
  const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
  const folder = location.pathname.replace(/[^/]*$/, '');
  const given = token.value === '' ? '' : `&token=${token.value}`;
  const mine = new WebSocket(`${scheme}//${location.host}${folder}api/v1/stream?hz=${rate}${given}`);
  socket = mine;
  openedAt = performance.now();
  mine.onmessage = (event) => {
    if (socket === mine) hear(String(event.data));
  };
  mine.onclose = () => {
    if (socket === mine) lose();
  };
}

// A browser makes a WebSocket wait longer and longer after each failure. So a plain request looks whether the server is
// there. It also tells whether the token is refused, which looks like any failure to a WebSocket.
async function retry(): Promise<void> {
  if (closed || socket !== undefined) return;
  try {
    await get('/status');
    open();
  } catch (error) {
    if (error instanceof Refused && error.status === 401) connection.value = 'token';
    setTimeout(() => void retry(), retryAfter);
  }
}

function lose(): void {
  const before = socket;
  socket = undefined;
  before?.close();
  // First of all: whatever else fails, the page tries again.
  setTimeout(() => void retry(), retryAfter);
  if (connection.value !== 'token') connection.value = 'lost';
}

function look(): void {
  if (socket === undefined) return;
  const patience = socket.readyState === WebSocket.CONNECTING ? openWithin : silentFor;
  const silence = performance.now() - Math.max(heardAt.value, openedAt);
  if (silence > patience) lose();
}

export function connect(): () => void {
  closed = false;
  open();
  const timer = setInterval(look, lookEvery);
  const atOnce = (): void => look();
  document.addEventListener('visibilitychange', atOnce);
  return () => {
    closed = true;
    clearInterval(timer);
    document.removeEventListener('visibilitychange', atOnce);
    socket?.close();
    socket = undefined;
  };
}

// Asks by the open connection, without waiting for an answer. False: there is no connection.
export function tell(path: string, body?: object): boolean {
  if (socket === undefined || socket.readyState !== WebSocket.OPEN || connection.value !== 'live') return false;
  socket.send(JSON.stringify({ do: `/api/v1${path}`, key: ownerKey.value, ...(body === undefined ? {} : { body }) }));
  return true;
}
