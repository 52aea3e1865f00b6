// Draws the stock: its heights are a texture, and each row of cells is a strip of triangles.
import { Program } from './gl';
import { stockFragment, stockVertex } from './shaders';
import type { HeightTexture } from './stock_cutter';

type Colour = readonly [number, number, number];

export class StockDrawing {
  private readonly program: Program;
  private readonly array: WebGLVertexArrayObject;
  private texture: WebGLTexture | null = null;
  private shape: HeightTexture | null = null;

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.program = new Program(gl, stockVertex, stockFragment);
    this.array = gl.createVertexArray();
  }

  begin(shape: HeightTexture): void {
    const { gl } = this;
    this.end();
    this.shape = shape;
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.R32F, shape.columns, shape.rows);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
  }

  write(first: number, heights: readonly Float32Array[]): void {
    const { gl } = this;
    if (this.shape === null) return;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    heights.forEach((row, i) => gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, first + i, row.length, 1, gl.RED, gl.FLOAT, row));
  }

  end(): void {
    if (this.texture !== null) this.gl.deleteTexture(this.texture);
    this.texture = null;
    this.shape = null;
  }

  draw(camera: Float32Array, light: readonly number[], colours: { stock: Colour; cut: Colour }, section: number): void {
    const { gl, program, shape } = this;
    if (shape === null) return;
    program.use();
    program.vector('camera', camera);
    program.vector('low', shape.block.low);
    program.vector('high', shape.block.high);
    program.vector('light', light);
    program.vector('stockColour', colours.stock);
    program.vector('cutColour', colours.cut);
    program.number('cell', shape.cell);
    program.number('section', section);
    program.integer('columns', shape.columns);
    program.integer('rows', shape.rows);
    program.integer('heights', 0);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.bindVertexArray(this.array);
    // A cell more on each side: the walls.
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, (2 * (shape.columns + 2) + 2) * (shape.rows + 1));
  }
}
