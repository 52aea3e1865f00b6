// The scene on a canvas: what is drawn when, and what a pointer does. It draws only when something has changed.
import { batch, effect, signal } from '@preact/signals';
import { stable } from '../core/stable';
import { theme, themeColour } from '../core/theme';
import { machine, status } from '../machine/connection';
import { pathIndex, pathLoaded } from '../machine/path_index';
import { workOffset, workRotation } from '../machine/place';
import { loadsOfShown } from '../machine/studies';
import { isUnderWay } from '../machine/words';
import { colouring, section, tells } from './colouring';
import { axesOf, fit, orbit, pan, project, views, zoom, type View } from './camera';
import { box, grid, gridStep, triad, triadEnds } from './furniture';
import { colourOf } from './gl';
import { noteLoads, spotOfLine, type PathPoints, type Vector } from './path_data';
import { finestChunks, levelFor, loadedChunks, listenToPath, wantFine } from './path_loader';
import { pick } from './pick';
import { doneOf } from './progress';
import { Renderer, type Colour } from './renderer';
import { StockScene } from './stock_scene';
import { cutters, stockCutter } from './stock_view';

// The line that a person has picked, in the text or in the scene.
export const picked = signal<number | null>(null);
export const showsRapids = signal(true);
export const followsTool = signal(false);
// The program whose path stands whole in the picture.
export const drawnProgram = signal<number | null>(null);

// What the picture shows of the status: the daemon tells the rest each second, and a still picture costs nothing.
const seen = stable(() => [status.value?.place, status.value?.line, status.value?.job?.state]);

const reachOfPick = 12; // CSS pixels
const clickMoves = 5; // pixels that a click may slip
const closerAfter = 120; // ms at rest
const aPicture = 20; // ms: what takes no longer is drawn as often as the screen shows it
// While the path is loaded, slow pictures get a quarter of the time, afterwards two thirds.
const restOf = (cost: number): number => Math.max(0, cost - aPicture) * (pathLoaded.peek() < 1 ? 3 : 0.5);

export class Stage {
  private readonly renderer: Renderer;
  private view: View = { centre: [0, 0, 0], ...views.iso, scale: 1 };
  private dirty = true;
  private frame = 0;
  private restsUntil = 0;
  private cost = 0; // of the last picture, ms
  private touched = false; // the person has chosen a view: it is not changed by itself
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private slipped = 0;
  private closerTimer: ReturnType<typeof setTimeout> | undefined;
  private readonly ends: (() => void)[] = [];
  private readonly stock: StockScene;
  drawn = 0; // frames, for tests

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly labels: HTMLElement,
  ) {
    this.renderer = new Renderer(canvas);
    this.stock = new StockScene(this.renderer);
    this.ends.push(
      listenToPath({ cleared: () => this.clear(), added: (points) => this.add(points) }),
      effect(() => this.colour(theme.value)),
      effect(() => this.furnish()),
      effect(() => {
        if (pathIndex.value !== null && !this.touched) this.fitAll();
      }),
      effect(() => {
        // The torque of each line, when it is known.
        const loads = loadsOfShown.value;
        if (loads?.state !== 'done' || tells.value !== 'torque') return;
        for (const one of loadedChunks()) noteLoads(one, loads.lines);
        this.renderer.renewChunks();
        this.soon();
      }),
      effect(() => {
        if (pathLoaded.value === 1) this.restsUntil = 0;
      }),
      effect(() => {
        // What changes the picture.
        void [seen.value, showsRapids.value, followsTool.value, picked.value, colouring.value, section.value, stockCutter.value, cutters.value, pathLoaded.value];
        this.soon();
      }),
    );
    const resize = new ResizeObserver(() => this.resize());
    resize.observe(canvas);
    this.ends.push(() => resize.disconnect());
    this.listen();
  }

  end(): void {
    for (const one of this.ends) one();
    cancelAnimationFrame(this.frame);
    clearTimeout(this.closerTimer);
    drawnProgram.value = null;
    this.renderer.end();
  }

  look(which: keyof typeof views): void {
    this.view = { ...this.view, ...views[which] };
    this.touched = false;
    this.fitAll();
  }

  fitAll(): void {
    const around = pathIndex.value?.all ?? this.travel();
    if (around !== null) this.view = fit(this.view, around.low, around.high, this.canvas.clientWidth, this.canvas.clientHeight);
    this.soon();
    this.closer();
  }

  private travel(): { low: Vector; high: Vector } | null {
    const axes = machine.value?.axes;
    if (axes === undefined) return null;
    const of = (name: string, end: 'low' | 'high'): number => axes.find((one) => one.axis === name)?.[end] ?? 0;
    const all = (end: 'low' | 'high'): Vector => [of('x', end), of('y', end), of('z', end)];
    return { low: all('low'), high: all('high') };
  }

  private zero(): Vector {
    const offset = workOffset.value;
    return [offset.x ?? 0, offset.y ?? 0, offset.z ?? 0];
  }

  private colour(_: string): void {
    const of = (name: string): Colour => colourOf(themeColour(name));
    // The theme's variables count once the document has its new theme.
    requestAnimationFrame(() => {
      this.renderer.colours = { ground: of('--scene'), cut: of('--cut'), rapid: of('--rapid'), past: of('--past'), tool: of('--tool'), low: of('--slow'), high: of('--fast'), stock: of('--stock'), floor: of('--floor') };
      this.furnish();
    });
  }

  private furnish(): void {
    const travel = this.travel();
    const zero = this.zero();
    const path = pathIndex.value?.all ?? null;
    if (travel === null) return;
    const of = (name: string): Colour => colourOf(themeColour(name));
    const size = path === null ? 200 : Math.max(path.high[0] - path.low[0], path.high[1] - path.low[1], 1);
    const reach = Math.hypot(...travel.high.map((high, k) => high - travel.low[k]!)) + Math.hypot(...zero) + size * 2;
    const lines = [
      ...grid(travel.low, travel.high, zero, gridStep(Math.max(size, 20) * 1.5), of('--grid')),
      ...box(travel.low, travel.high, of('--line')),
      ...triad(zero, Math.max(size * 0.12, 2), workRotation.value, [of('--x'), of('--y'), of('--z')]),
    ];
    this.renderer.setFurniture(lines, reach);
    this.soon();
  }

  private add(points: PathPoints): void {
    const loads = loadsOfShown.peek();
    if (loads?.state === 'done' && tells.peek() === 'torque') noteLoads(points, loads.lines);
    this.renderer.addChunk(points);
    this.soon();
  }
  private clear(): void {
    this.renderer.clearChunks();
    this.touched = false;
    this.soon();
  }

  private resize(): void {
    const density = window.devicePixelRatio;
    const first = this.canvas.width === 300;
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * density));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * density));
    if (!this.touched || first) this.fitAll();
    // A canvas of another size is black until it is drawn, and nobody should see that.
    this.paint();
  }

  private soon(): void {
    if (this.dirty && this.frame !== 0) return;
    this.dirty = true;
    this.frame = requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    if (this.renderer.isBusy() || performance.now() < this.restsUntil) {
      this.frame = requestAnimationFrame(() => this.draw());
      return;
    }
    this.paint();
  }

  // Where the processor draws, the page stands still until the picture is done: the next frame tells how long it took.
  private paint(): void {
    const begun = performance.now();
    const whole = pathLoaded.peek() === 1 ? (pathIndex.peek()?.program ?? null) : null;
    requestAnimationFrame(() => {
      const now = performance.now();
      drawnProgram.value = whole;
      this.cost = now - begun;
      this.restsUntil = now + restOf(this.cost);
    });
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.dirty = false;
    ++this.drawn;
    const now = status.peek();
    const tool: Vector | null = now === null ? null : [now.place.x ?? 0, now.place.y ?? 0, now.place.z ?? 0];
    if (tool !== null && followsTool.peek()) this.view = { ...this.view, centre: tool };
    const runs = now !== null && isUnderWay(now.job) && now.line > 0;
    const cutsMore = this.stock.advance(runs ? now.line : null, tool, this.cost);
    const done = runs && tool !== null ? doneOf(finestChunks(), now.line, tool) : null;
    this.renderer.draw(
      { view: this.view, tool, showsRapids: showsRapids.peek(), done, colouring: colouring.peek(), section: section.peek() },
      this.level(),
    );
    this.label();
    if (cutsMore) this.soon();
  }

  private level(): number {
    const index = pathIndex.peek();
    return index === null ? 0 : levelFor(index, this.view.scale / window.devicePixelRatio);
  }

  // The letters at the axes, and the mark at the picked line.
  private label(): void {
    const axes = axesOf(this.view);
    const zero = this.zero();
    const index = pathIndex.peek();
    const size = index?.all == null ? 200 : Math.max(index.all.high[0] - index.all.low[0], index.all.high[1] - index.all.low[1], 1);
    const ends = triadEnds(zero, Math.max(size * 0.12, 2) * 1.12, workRotation.peek());
    const line = picked.peek();
    const spot = line === null ? null : spotOfLine(finestChunks(), line);
    for (const one of this.labels.children) {
      if (!(one instanceof HTMLElement)) continue;
      const axis = 'xyz'.indexOf(one.dataset.axis ?? '-');
      const place: Vector = ends[axis] ?? spot?.place ?? [0, 0, 0];
      const [x, y] = project(this.view, axes, place);
      one.hidden = axis < 0 && spot === null;
      one.style.transform = `translate(${x + this.canvas.clientWidth / 2}px, ${y + this.canvas.clientHeight / 2}px)`;
    }
  }

  // At rest, what is in sight is loaded as fine as it is shown.
  private closer(): void {
    clearTimeout(this.closerTimer);
    this.closerTimer = setTimeout(() => {
      if (this.level() === 0) wantFine(this.renderer.chunksInSight(this.view, this.canvas.clientWidth, this.canvas.clientHeight));
    }, closerAfter);
  }

  private middle(event: { clientX: number; clientY: number }): [number, number] {
    const around = this.canvas.getBoundingClientRect();
    return [event.clientX - around.left - around.width / 2, event.clientY - around.top - around.height / 2];
  }

  private listen(): void {
    const on = <K extends keyof HTMLElementEventMap>(name: K, act: (event: HTMLElementEventMap[K]) => void): void => {
      this.canvas.addEventListener(name, act, { passive: false });
      this.ends.push(() => this.canvas.removeEventListener(name, act));
    };
    on('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      if (this.pointers.size === 0) this.slipped = 0;
      this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    on('pointermove', (event) => this.drag(event));
    on('pointerup', (event) => {
      this.pointers.delete(event.pointerId);
      if (this.slipped < clickMoves && event.button === 0) this.pick(event);
    });
    on('pointercancel', (event) => this.pointers.delete(event.pointerId));
    on('contextmenu', (event) => event.preventDefault());
    on('wheel', (event) => {
      event.preventDefault();
      const [x, y] = this.middle(event);
      this.change(zoom(this.view, Math.exp(event.deltaY * 0.0015), x, y));
    });
  }

  private change(view: View): void {
    this.view = view;
    this.touched = true;
    this.soon();
    this.closer();
  }

  private drag(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (before === undefined) return;
    const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
    this.slipped += Math.abs(dx) + Math.abs(dy);
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other !== undefined) {
      const apart = Math.hypot(before.x - other.x, before.y - other.y);
      const now = Math.hypot(event.clientX - other.x, event.clientY - other.y);
      const [x, y] = this.middle({ clientX: (event.clientX + other.x) / 2, clientY: (event.clientY + other.y) / 2 });
      this.change(pan(zoom(this.view, apart / Math.max(1, now), x, y), dx / 2, dy / 2));
    } else if (this.slipped >= clickMoves) {
      const moves = event.shiftKey || (event.buttons & 6) !== 0;
      this.change(moves ? pan(this.view, dx, dy) : orbit(this.view, dx, dy));
    }
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }

  private pick(event: PointerEvent): void {
    const [x, y] = this.middle(event);
    const spot = pick(finestChunks(), this.view, x, y, reachOfPick, showsRapids.value);
    batch(() => (picked.value = spot?.line ?? null));
  }
}
