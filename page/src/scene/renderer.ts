// Draws the scene. It knows neither the daemon nor the page: it is given chunks, lines, a view and a tool's place.
import { axesOf, matrixOf, project, type View } from './camera';
import { asNumbers, cone, type Line } from './furniture';
import { bufferOf, isDrawnByProcessor, Program } from './gl';
import type { PathPoints, Vector } from './path_data';
import { boxOf } from './path_data';
import { StockDrawing } from './stock_drawing';
import { lineFragment, lineVertex, pathFragment, pathVertex, pointsARow, toolFragment, toolVertex } from './shaders';

const mostBusy = 1000; // ms
const fewQuads = 32; // 64 triangles: half the memory, and a picture takes a quarter longer

export type Colour = [number, number, number];
export interface Colours {
  ground: Colour;
  cut: Colour;
  rapid: Colour;
  past: Colour;
  tool: Colour;
  low: Colour;
  high: Colour;
  stock: Colour;
  floor: Colour; // of what is cut
}

interface DrawnChunk {
  points: PathPoints;
  texture: WebGLTexture;
}

export interface Picture {
  view: View;
  tool: Vector | null;
  showsRapids: boolean;
  // The motion that is being executed: all before it are done.
  done: { chunk: number; share: number } | null;
  colouring: Colouring;
  section: number; // mm: nothing above it is drawn
}

// What the colour of a cut tells, and between which values: of the speed's code, of the height in mm, or of the torque's code.
export interface Colouring {
  tells: 'nothing' | 'speed' | 'depth' | 'torque';
  low: number;
  high: number;
}

export class Renderer {
  private readonly gl: WebGL2RenderingContext;
  private readonly path: Program;
  private readonly line: Program;
  private readonly tool: Program;
  readonly stock: StockDrawing;
  private readonly nothing: WebGLVertexArrayObject; // the path's vertices read a texture
  private readonly cone: WebGLVertexArrayObject;
  private readonly coneCount: number;
  private readonly soft: number; // device pixels over which the edge of a line fades
  private readonly chunks = new Map<string, DrawnChunk>();
  private furniture: { array: WebGLVertexArrayObject; count: number } | null = null;
  private fence: WebGLSync | null = null; // of the last picture
  private drawnAt = 0; // ms, of the page's clock
  private reach = 1000; // mm: beyond this nothing is drawn
  colours: Colours = { ground: [0, 0, 0], cut: [1, 1, 1], rapid: [1, 1, 0], past: [0.5, 0.5, 0.5], tool: [1, 1, 0], low: [0, 0, 1], high: [1, 0, 0], stock: [0.8, 0.7, 0.5], floor: [0.5, 0.4, 0.3] };

  // Throws where there is no WebGL2.
  constructor(readonly canvas: HTMLCanvasElement) {
    const gl = canvas.getContext('webgl2', { antialias: !isDrawnByProcessor(), alpha: false, powerPreference: 'low-power' });
    if (gl === null) throw new Error('there is no WebGL2');
    this.gl = gl;
    this.path = new Program(gl, pathVertex, pathFragment);
    this.line = new Program(gl, lineVertex, lineFragment);
    this.tool = new Program(gl, toolVertex, toolFragment);
    this.stock = new StockDrawing(gl);
    this.nothing = gl.createVertexArray();
    const numbers = cone();
    this.coneCount = numbers.length / 6;
    this.cone = gl.createVertexArray();
    gl.bindVertexArray(this.cone);
    bufferOf(gl, numbers);
    this.attribute(0, 3, 24, 0);
    this.attribute(1, 3, 24, 12);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    this.soft = gl.getParameter(gl.SAMPLES) > 0 ? 0 : 1;
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (this.soft > 0) gl.enable(gl.BLEND);
  }

  private attribute(index: number, size: number, stride: number, offset: number): void {
    this.gl.enableVertexAttribArray(index);
    this.gl.vertexAttribPointer(index, size, this.gl.FLOAT, false, stride, offset);
  }

  // Neighbouring motions share their points: a motion reads two of them.
  addChunk(points: PathPoints): void {
    if (points.count < 2) return;
    const gl = this.gl;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const rows = Math.ceil(points.count / pointsARow);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16UI, pointsARow, rows);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    this.write(points);
    this.chunks.set(`${points.chunk}/${points.level}`, { points, texture });
  }

  // Full rows at once, then the rest.
  private write({ count, places }: PathPoints): void {
    const gl = this.gl;
    const full = Math.floor(count / pointsARow);
    for (const [row, width, rows] of [[0, pointsARow, full], [full, count % pointsARow, 1]] as const) {
      const from = row * pointsARow * 4;
      if (width * rows > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, width, rows, gl.RGBA_INTEGER, gl.UNSIGNED_SHORT, places.subarray(from, from + width * rows * 4));
    }
  }

  // The flags of all points have changed.
  renewChunks(): void {
    for (const one of this.chunks.values()) {
      this.gl.bindTexture(this.gl.TEXTURE_2D, one.texture);
      this.write(one.points);
    }
  }

  clearChunks(): void {
    for (const one of this.chunks.values()) this.gl.deleteTexture(one.texture);
    this.chunks.clear();
  }

  setFurniture(lines: readonly Line[], reach: number): void {
    if (this.furniture !== null) this.gl.deleteVertexArray(this.furniture.array);
    this.reach = reach;
    const array = this.gl.createVertexArray();
    this.gl.bindVertexArray(array);
    bufferOf(this.gl, asNumbers(lines));
    this.attribute(0, 3, 40, 0);
    this.attribute(1, 3, 40, 12);
    this.attribute(2, 4, 40, 24);
    this.gl.bindVertexArray(null);
    this.furniture = { array, count: lines.length };
  }

  // The finest loaded level of each chunk that is seen, but not finer than `level` asks.
  private seen(level: number, view: View, width: number, height: number): DrawnChunk[] {
    const best = new Map<number, DrawnChunk>();
    for (const one of this.chunks.values()) {
      const before = best.get(one.points.chunk);
      const better = (a: number, b: number): boolean => Math.abs(a - level) < Math.abs(b - level);
      if (before === undefined || better(one.points.level, before.points.level)) best.set(one.points.chunk, one);
    }
    return [...best.values()].filter((one) => isSeen(one.points, view, width, height));
  }

  chunksInSight(view: View, width: number, height: number): number[] {
    return this.seen(0, view, width, height).map((one) => one.points.chunk);
  }

  // The picture before is not finished: a slow GPU, or none, would only get further behind.
  isBusy(): boolean {
    const { gl, fence } = this;
    if (fence === null) return false;
    const waits = gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED && performance.now() - this.drawnAt < mostBusy;
    if (waits) return true;
    gl.deleteSync(fence);
    this.fence = null;
    return false;
  }

  draw(picture: Picture, level: number): void {
    const { gl, canvas } = this;
    const density = canvas.width / Math.max(1, canvas.clientWidth);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...this.colours.ground, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const camera = matrixOf(picture.view, width, height, this.reach * 2);
    const window = [canvas.width, canvas.height];
    const { right, up, back } = axesOf(picture.view);
    const light = [0, 1, 2].map((k) => right[k]! * 0.35 + up[k]! * 0.45 + back[k]! * 0.82);
    // Before the lines, whose soft edges let through what is drawn already.
    this.stock.draw(camera, light, { stock: this.colours.stock, cut: this.colours.floor }, picture.section);
    if (this.furniture !== null && this.furniture.count > 0) {
      this.line.use();
      this.line.vector('camera', camera);
      this.line.vector('window', window);
      this.line.number('density', density);
      this.line.number('soft', this.soft);
      gl.bindVertexArray(this.furniture.array);
      this.drawQuads(this.furniture.count);
    }
    this.drawPath(picture, level, camera, density);
    if (picture.tool !== null) this.drawTool(picture.tool, camera, picture.view, light);
    gl.bindVertexArray(null);
    if (this.fence !== null) gl.deleteSync(this.fence);
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    this.drawnAt = performance.now();
  }

  private drawPath(picture: Picture, level: number, camera: Float32Array, density: number): void {
    const { gl, canvas, path } = this;
    path.use();
    path.vector('camera', camera);
    path.vector('window', [canvas.width, canvas.height]);
    path.vector('cutColour', this.colours.cut);
    path.vector('rapidColour', this.colours.rapid);
    path.vector('pastColour', this.colours.past);
    path.number('thickness', 1.7 * density);
    path.number('soft', this.soft);
    path.number('showsRapids', picture.showsRapids ? 1 : 0);
    path.number('dash', 9 * density);
    path.integer('tells', ['nothing', 'speed', 'depth', 'torque'].indexOf(picture.colouring.tells));
    path.vector('range', [picture.colouring.low, picture.colouring.high]);
    path.vector('lowColour', this.colours.low);
    path.vector('highColour', this.colours.high);
    path.number('section', picture.section);
    path.integer('points', 0);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindVertexArray(this.nothing);
    for (const one of this.seen(level, picture.view, canvas.clientWidth, canvas.clientHeight)) {
      const { points } = one;
      const { done } = picture;
      const before = done !== null && points.chunk < done.chunk;
      const within = done !== null && points.chunk === done.chunk ? Math.floor(done.share * (points.count - 1)) : 0;
      path.vector('origin', points.origin);
      path.vector('stepLength', points.step);
      path.integer('done', before ? points.count : within);
      gl.bindTexture(gl.TEXTURE_2D, one.texture);
      this.drawQuads(points.count - 1);
    }
  }

  // Where the processor draws, in small draws: SwiftShader works at 16 at a time, and keeps up to 128 triangles of each,
  // 10 kB a triangle.
  private drawQuads(count: number): void {
    const atOnce = this.soft > 0 ? fewQuads : count;
    for (let from = 0; from < count; from += atOnce) {
      this.gl.drawArrays(this.gl.TRIANGLES, 6 * from, 6 * Math.min(atOnce, count - from));
    }
  }

  private drawTool(place: Vector, camera: Float32Array, view: View, light: readonly number[]): void {
    const { gl, tool } = this;
    tool.use();
    tool.vector('camera', camera);
    tool.vector('tip', place);
    tool.vector('light', light);
    tool.vector('toolColour', this.colours.tool);
    tool.number('size', 46 * view.scale);
    gl.bindVertexArray(this.cone);
    gl.drawArrays(gl.TRIANGLES, 0, this.coneCount);
  }

  // Else the graphics of a page that was left would stay until the browser next tidies up its memory.
  end(): void {
    this.gl.getExtension('WEBGL_lose_context')?.loseContext();
  }

  bytes(): number {
    let all = 0;
    for (const one of this.chunks.values()) all += one.points.places.byteLength;
    return all;
  }
}

export function isSeen(points: PathPoints, view: View, width: number, height: number): boolean {
  const { low, high } = boxOf(points);
  const axes = axesOf(view);
  let [left, right, top, bottom] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let corner = 0; corner < 8; ++corner) {
    const place: Vector = [corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1], corner & 4 ? high[2] : low[2]];
    const [x, y] = project(view, axes, place);
    [left, right, top, bottom] = [Math.min(left, x), Math.max(right, x), Math.min(top, y), Math.max(bottom, y)];
  }
  return left < width / 2 && right > -width / 2 && top < height / 2 && bottom > -height / 2;
}
