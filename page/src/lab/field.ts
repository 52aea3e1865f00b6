// A value of the address: how it is read and written.
export interface Field<T> {
  usual: T;
  read: (text: string) => T | undefined;
  write: (value: T) => string;
  expects: string; // the range or the choices, for everybody
}
export interface NumericField extends Field<number> {
  from: number;
  to: number;
  whole: boolean;
}
export const range = (from: number, to: number): string => `${from} … ${to}`.replaceAll('-', '−');
