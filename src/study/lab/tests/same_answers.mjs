// node same_answers.mjs lab.wasm passo: the browser's module answers with the numbers of the program, for many moves by
// all methods, arcs, ramps, windings, motors and loops. The program's numbers are its CSV and JSON, as it prints them.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';

const [wasmFile, passoProgram] = process.argv.slice(2);

// The module opens no file and writes nowhere: whatever it asks of a system is refused.
const module = new WebAssembly.Module(readFileSync(wasmFile));
const refused = 8; // EBADF
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = () => refused;
const lab = new WebAssembly.Instance(module, imports).exports;
lab._initialize();

function ask(name, ...values) {
  const length = lab[name](...values);
  const answer = JSON.parse(new TextDecoder().decode(new Uint8Array(lab.memory.buffer, lab.lab_answer(), length)));
  return answer;
}
function passo(...words) {
  const done = spawnSync(passoProgram, words.map(String), { encoding: 'utf8', maxBuffer: 1 << 26 });
  assert.equal(done.status, 0, `passo ${words.join(' ')}: ${done.stderr}`);
  return done.stdout;
}
// CSV by column: {name: [text…]}.
function columnsOf(text) {
  const [names, ...rows] = text.trim().split('\n').map((line) => line.split(','));
  return Object.fromEntries(names.map((name, column) => [name, rows.map((row) => row[column])]));
}
// As a person sees them, to so many digits.
function assertSame(mine, printed, digits, what) {
  assert.equal(mine.length, printed.length, what);
  mine.forEach((value, i) => {
    const other = Number(printed[i]);
    const off = Math.abs(value - other);
    assert.ok(off <= Math.abs(other) * 10 ** (1 - digits) + 1e-12, `${what}, row ${i}: ${value}, not ${other}`);
  });
}
const texts = (values) => values.map(String);

// Park and Miller's numbers: the same moves at every run.
let seed = 20_230;
function random(from, to) {
  seed = (seed * 48_271) % 2_147_483_647;
  return from + (seed % (to - from + 1));
}

const lineMethods = ['master-slave', 'lean', 'dda', 'slope-recalculated', 'slope-blocks', 'point-comparison'];
const allMethods = [
  ...lineMethods, 'midpoint', 'listing:rounding', 'listing:shared-variable', 'listing:slope-blocks', 'listing:projection',
];
let compared = 0;

function compareMove(name, halfLoaded, from, to, arc) {
  const words = ['interpolate', '--method', name, '--beats', `--from=${from}`, `--to=${to}`];
  if (halfLoaded) words.push('--half-loaded');
  if (arc) words.push(`--center=${arc.centre}`, ...(arc.clockwise ? ['--cw'] : []));
  const what = words.join(' ');
  const printed = columnsOf(passo(...words));
  const sense = arc ? (arc.clockwise ? 2 : 1) : 0;
  const method = allMethods.indexOf(name);
  const mine = ask('lab_interpolation', method, halfLoaded ? 1 : 0, ...from, ...to, sense, ...(arc?.centre ?? [0, 0]));
  assert.equal(mine.error, undefined, what);
  assert.deepEqual(texts(mine.x), printed.x, what);
  assert.deepEqual(texts(mine.y), printed.y, what);
  for (const [column, values] of Object.entries({ ...mine.judge, ...mine.decisions, ...mine.end })) {
    assert.deepEqual(texts(values), printed[column], `${what}: ${column}`);
  }
  ++compared;
}

function compareFigures(from, to, arc) {
  const words = ['interpolate', '--compare', '--json', `--from=${from}`, `--to=${to}`];
  if (arc) words.push(`--center=${arc.centre}`, ...(arc.clockwise ? ['--cw'] : []));
  const printed = JSON.parse(passo(...words));
  const mine = ask('lab_comparison', ...from, ...to, arc ? (arc.clockwise ? 2 : 1) : 0, ...(arc?.centre ?? [0, 0]));
  assert.equal(mine.methods.length, printed.methods.length);
  mine.methods.forEach((method, i) => {
    const other = printed.methods[i];
    const what = `${words.join(' ')}: ${method.title}`;
    assert.equal(method.title, other.method);
    for (const count of ['pulses', 'together', 'idle']) assert.equal(method[count], other[count], what);
    const rules = Object.keys(other.speed);
    const own = [method.largest, method.mean, ...rules.flatMap((rule) => [method.lag[rule], method.ratio[rule]])];
    const theirs = [
      other.largest_deviation_steps,
      other.mean_deviation_steps,
      ...rules.flatMap((rule) => [other.speed[rule].lag_steps, other.speed[rule].ratio]),
    ];
    assertSame(own, theirs, 9, what);
  });
}

// Lines: every octant, the axes, the diagonals, and many more.
const ends = [[10, 4], [7, 3], [27, 10], [1, 0], [0, -9], [8, 8], [-8, 8], [3, 29], [22, 15]];
while (ends.length < 24) ends.push([random(-60, 60), random(-60, 60)]);
for (const end of ends.filter(([x, y]) => x !== 0 || y !== 0)) {
  for (const name of lineMethods) compareMove(name, false, [0, 0], end);
  compareMove('dda', true, [random(-9, 9), random(-9, 9)], end);
  compareFigures([0, 0], end);
}
// Faulty listings, and lines of several axes.
for (const name of allMethods.slice(7)) {
  for (const end of [[22, 15], [3, 29], [-8, 8], [10, 4]]) compareMove(name, false, [0, 0], end);
}
for (const end of [[10, 4, 7], [5, -9, 3, 0, 2], [7, 3, 1, -6, 5, 4, 2, 7]]) {
  for (const name of ['master-slave', 'lean', 'dda', 'listing:rounding', 'listing:shared-variable']) {
    const printed = columnsOf(passo('interpolate', '--method', name, '--beats', `--to=${end}`));
    const padded = [...end, ...new Array(8 - end.length).fill(0)];
    const mine = ask('lab_line', allMethods.indexOf(name), 0, end.length, ...padded);
    assert.equal(mine.error, undefined, name);
    end.forEach((_, axis) => assert.deepEqual(texts(mine.places[axis]), printed['xyzabcuv'[axis]], `${name} to ${end}`));
    for (const [column, values] of Object.entries({ ...mine.judge, ...mine.decisions, ...mine.end })) {
      assert.deepEqual(texts(values), printed[column], `${name} to ${end}: ${column}`);
    }
    ++compared;
  }
}

// Arcs: both senses, full circles, ends beside the circle.
for (let i = 0; i < 8; ++i) {
  const radius = random(3, 40);
  const angle = (random(0, 359) * Math.PI) / 180;
  const centre = [random(-5, 5), random(-5, 5)];
  const from = [centre[0] + radius, centre[1]];
  const to = i === 0 ? from : [centre[0] + Math.round(radius * Math.cos(angle)), centre[1] + Math.round(radius * Math.sin(angle))];
  const arc = { centre, clockwise: i % 2 === 1 };
  for (const name of ['point-comparison', 'dda', 'midpoint']) compareMove(name, false, from, to, arc);
  compareFigures(from, to, arc);
}

// Ramps and whole moves.
const rampMethods = ['exact', 'recursive', 'table', 'midpoint'];
const ramps = [
  { clock: 250_000, turn: 400, accel: 50, steps: 24 },
  { clock: 250_000, turn: 400, accel: 50, steps: 1000, move: true, rate: 1500 },
  { clock: 1_000_000, turn: 200, accel: 400, steps: 601, move: true, rate: 3000, start: 300 },
  { clock: 1_000_000, turn: 200, accel: 50, steps: 1000, move: true, rate: 1500, jerk: 500, methods: ['exact'] },
  { clock: 250_000, turn: 200, accel: 100, steps: 300, rate: 900, whole: true, methods: ['exact', 'recursive'] },
];
for (const { clock, turn, accel, steps, move, rate, start, jerk, whole, methods = rampMethods } of ramps) {
  for (const name of methods) {
    const words = ['ramp', '--method', name, '--clock', clock, '--steps-per-rev', turn, '--accel', accel];
    words.push(move ? '--move' : '--steps', steps);
    for (const [option, value] of [['--max-rate', rate], ['--start-rate', start], ['--jerk', jerk]]) {
      if (value) words.push(option, value);
    }
    if (whole) words.push('--whole-ticks');
    const printed = columnsOf(passo(...words));
    const mine = ask('lab_ramp', rampMethods.indexOf(name), clock, turn, accel, steps, move ? 1 : 0, whole ? 1 : 0,
                     rate ?? 0, start ?? 0, jerk ?? 0, 0);
    assert.equal(mine.error, undefined, words.join(' '));
    assertSame(mine.ticks, printed.c, 12, words.join(' '));
    assertSame(mine.end_s.map((end) => end * clock), printed.t_end, 12, words.join(' '));
    ++compared;
  }
}
assert.match(ask('lab_ramp', 2, 1e6, 200, 1, 100, 0, 0, 0, 0, 0, 0).error, /16 bits/);

// Windings and rotor.
const drives = ['two-on', 'wave', 'half-step', 'microsteps:2', 'microsteps:8', 'microsteps:16'];
for (const drive of drives) {
  const index = drive.startsWith('micro') ? 1 + Number(drive.split(':')[1]) : drives.indexOf(drive);
  const printed = columnsOf(passo('windings', '--drive', drive, '--method', 'lean', '--to', '70', '--time', '1'));
  const mine = ask('lab_windings', index, 200, 0, 70);
  assertSame(mine.phase_a, printed.x_a, 5, drive);
  assertSame(mine.phase_b, printed.x_b, 5, drive);
  assertSame(mine.degrees, printed.x_deg, 5, drive);
  for (let output = 0; output < 4; ++output) {
    const column = mine.pattern.map((pattern) => String((pattern >> output) & 1));
    assert.deepEqual(column, printed[`x_f${output + 1}`], drive);
  }
  ++compared;
}

// The current of a winding that is switched on: F2 after the first step of a wave drive. A row of the program is an
// eighth of the time constant; the rate of the question makes the lab's points as far apart.
const winding = ['--current', 1, '--resistance', 12.8, '--inductance', 10, '--drop', 1];
for (const [stage, supply, series] of [['plain', 13.8, 0], ['series', 36, 22.2]]) {
  const words = ['windings', '--drive', 'wave', '--to', 1, '--time', 0.02, ...winding, '--supply', supply, '--series', series];
  const printed = columnsOf(passo(...words)).x_b.slice(1, 42);
  lab.lab_motor(200, 68e-7, 0.45, 1, 12.8, 10e-3, 13.8, 1, 0, 0);
  const apart = 10e-3 / (12.8 + series) / 8;
  const mine = ask('lab_driver', 1, 36, 22.2, 0.1, 4 / (600 * apart), 750, 1.4, 5, 0.3, 470);
  assertSame(mine[stage].current_a.slice(0, 41), printed, 5, `the current of the stage ${stage}`);
  ++compared;
}

// Torque.
const motor = ['--holding-torque', 0.45, '--current', 1.7, '--resistance', 1.5, '--inductance', 2.8];
motor.push('--rotor-inertia', 68, '--supply', 24, '--load-inertia', 68, '--friction', 0.01);
for (const [regulation, name] of ['chopper', 'resistive'].entries()) {
  const printed = columnsOf(passo('motor', ...motor, '--rows', 60, '--margin', 0.7, '--regulation', name));
  lab.lab_motor(200, 68e-7, 0.45, 1.7, 1.5, 2.8e-3, 24, regulation, 68e-7, 0.01);
  const mine = ask('lab_torque', 0.7, 5000, 60);
  for (const column of ['rate_hz', 'pull_out_nm', 'pull_in_nm', 'acceleration_rad_s2']) {
    assertSame(mine[column], printed[column], 9, `motor, ${name}: ${column}`);
  }
  const loaded = [...motor.slice(0, -1), 0.01 + (68e-7 + 68e-7) * 5000];
  const fastest = JSON.parse(passo('motor', ...loaded, '--regulation', name, '--json')).fastest_rate_hz;
  assertSame([mine.accelerated_rate_hz], [fastest], 9, 'the rate to which the motor has the torque');
  ++compared;
}

// Closed loops: the motor of `passo loop`.
lab.lab_motor(200, 68e-7, 0.45, 1.7, 1.5, 2.8e-3, 24, 0, 68e-7, 0.01);
const loop = columnsOf(passo('loop', '--gains', '0.02,2,0', '--load', '0.1@0.05', '--time', 0.1));
const period = 100 * 1e-6; // as the program says 100 µs
const speed = ask('lab_loop', 0, 30, period, 0.02, 2, 0, 0, 0, 0.1, 0.05, 0.1);
assertSame(speed.time_s, loop.time_s, 9, 'loop');
// Sines of two C libraries may differ in their last digit, and a count of the encoder then comes a period later.
speed.is.forEach((value, i) => assert.ok(Math.abs(value - Number(loop.is[i])) < 0.02 * 30, `loop, row ${i}`));
const rule = JSON.parse(passo('loop', '--rule', 'pi', '--json')).ultimate;
const ultimate = ask('lab_ultimate', 0, 30, period, 0, 0);
assertSame([ultimate.gain, ultimate.period_s], [rule.gain, rule.period_s], 2, 'ultimate cycle');

// What is wrong is said, and what is too long is refused.
assert.match(ask('lab_interpolation', 3, 0, 5, 0, 0, 5, 1, 0, 0).error, /is for lines/);
assert.match(ask('lab_interpolation', 1, 0, 0, 0, 2_000_000_000, 5, 0, 0, 0).error, /more than 20000 pulses/);
assert.match(ask('lab_interpolation', 6, 0, 5, 0, 2, 0, 1, 0, 0).error, /does not end on its circle/);
assert.match(ask('lab_comparison', 0, 0, 2_000_000_000, 5, 0, 0, 0).error, /too long/);
assert.match(ask('lab_loop', 0, 0, 1e-4, 1, 0, 0, 0, 0, 0, 0, 0.1).error, /a step other than 0/);
assert.match(ask('lab_ramp', 0, -1, 200, 1, 10, 0, 0, 0, 0, 0, 0).error, /clock/);

console.log(`${compared} answers are those of the program`);
