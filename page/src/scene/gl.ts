// A thin layer over WebGL2: programs, buffers, and what draws.

export class Program {
  private readonly places = new Map<string, WebGLUniformLocation | null>();
  readonly program: WebGLProgram;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    vertex: string,
    fragment: string,
  ) {
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
      const shader = gl.createShader(kind);
      if (shader === null) throw new Error('WebGL is lost');
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
        throw new Error(gl.getShaderInfoLog(shader) ?? 'a shader is wrong');
      }
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
  }

  use(): void {
    this.gl.useProgram(this.program);
  }
  place(name: string): WebGLUniformLocation | null {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
    return this.places.get(name) ?? null;
  }
  vector(name: string, value: readonly number[] | Float32Array): void {
    if (value.length === 2) this.gl.uniform2fv(this.place(name), value);
    else if (value.length === 16) this.gl.uniformMatrix4fv(this.place(name), false, value);
    else this.gl.uniform3fv(this.place(name), value);
  }
  number(name: string, value: number): void {
    this.gl.uniform1f(this.place(name), value);
  }
  integer(name: string, value: number): void {
    this.gl.uniform1i(this.place(name), value);
  }
}

export function bufferOf(gl: WebGL2RenderingContext, data: AllowSharedBufferSource): WebGLBuffer {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  return buffer;
}

// Whether there is no graphics card, as far as the browser tells. Then four samples a pixel cost 34 MB and time: the
// shaders soften the edges of lines instead. A context shows its samples only when it is too late to choose them.
export function isDrawnByProcessor(): boolean {
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2', { depth: false, antialias: false, powerPreference: 'low-power' });
  const asked = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl == null || asked == null ? '' : String(gl.getParameter(asked.UNMASKED_RENDERER_WEBGL));
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

// "#35d0ba" or "rgb(…)" as numbers from 0 to 1.
export function colourOf(text: string): [number, number, number] {
  const short = /^#([0-9a-f]{3})$/i.exec(text)?.[1];
  const hex = short !== undefined ? [...short].map((c) => c + c).join('') : /^#([0-9a-f]{6})/i.exec(text)?.[1];
  if (hex === undefined) return [0.5, 0.5, 0.5];
  const part = (at: number): number => parseInt(hex.slice(at, at + 2), 16) / 255;
  return [part(0), part(2), part(4)];
}
