// The functions that the page offers to the module: they read the visitor's files and report the progress of the check
// (src/core/base/include/passo/base/browser_host.hpp in C++).

export const stages = ['reading', 'planning', 'proposals'] as const;
export type Stage = (typeof stages)[number];

// Returns the bytes of a file from an offset on. Throws if the browser cannot read it.
export type ReadPart = (from: number, size: number) => Uint8Array;
export interface HostFile {
  size: number;
  read: ReadPart;
}

type Check = Record<'check_program' | 'check_import' | 'check_answer' | 'check_room' | 'check_path', (...numbers: number[]) => number>;

// The module with its files. A check is one long call.
export class CheckModule {
  private constructor(
    private readonly call: Check,
    private readonly memory: WebAssembly.Memory,
    private readonly files: Map<string, HostFile>,
  ) {}

  static async start(bytes: BufferSource, progress: (stage: Stage, share: number) => void): Promise<CheckModule> {
    const files = new Map<string, HostFile>();
    let memory: WebAssembly.Memory | undefined;
    const part = (at: number, size: number): Uint8Array => new Uint8Array(memory!.buffer, at, size);
    const fileOf = (at: number, size: number): HostFile | undefined => files.get(new TextDecoder().decode(part(at, size)));
    const host = {
      size: (at: number, length: number): number => fileOf(at, length)?.size ?? -1,
      read: (at: number, length: number, to: number, size: number, from: number): number => {
        const file = fileOf(at, length);
        try {
          const bytes = file?.read(from, Math.max(0, Math.min(size, file.size - from)));
          if (bytes === undefined) return -1;
          part(to, bytes.length).set(bytes);
          return bytes.length;
        } catch {
          return -1;
        }
      },
      progress: (stage: number, share: number): void => progress(stages[stage] ?? 'reading', share),
    };
    // All other system functions that the C library may call return an error.
    const refused = 8;
    const module = await WebAssembly.compile(bytes);
    const imports: WebAssembly.Imports = { host };
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
      if (from !== 'host') imports[from] = { ...imports[from], [name]: () => refused };
    }
    const { exports } = await WebAssembly.instantiate(module, imports);
    memory = exports.memory as WebAssembly.Memory;
    (exports._initialize as () => void)();
    return new CheckModule(exports as unknown as Check, memory, files);
  }

  get bytes(): number {
    return this.memory.buffer.byteLength;
  }
  addFile(name: string, file: HostFile): void {
    this.files.set(name, file);
  }
  check(request: object): string {
    this.give(request);
    return new TextDecoder().decode(this.answer(this.call.check_program()));
  }
  // Makes a machine file from another controller's configuration.
  import(request: object): string {
    this.give(request);
    return new TextDecoder().decode(this.answer(this.call.check_import()));
  }
  private give(request: object): void {
    const text = new TextEncoder().encode(JSON.stringify(request));
    const at = this.call.check_room(text.length);
    new Uint8Array(this.memory.buffer, at, text.length).set(text);
  }
  // Chunks of the path, one after the other.
  path(first: number, count: number, level: number): Uint8Array<ArrayBuffer> {
    const parts: Uint8Array[] = [];
    for (let i = first; i < first + count; ++i) parts.push(this.answer(this.call.check_path(i, level)).slice());
    const all = new Uint8Array(parts.reduce((size, one) => size + one.length, 0));
    let at = 0;
    for (const one of parts) {
      all.set(one, at);
      at += one.length;
    }
    return all;
  }
  private answer(length: number): Uint8Array {
    return new Uint8Array(this.memory.buffer, this.call.check_answer(), length);
  }
}
