import { afterEach, describe, expect, it } from 'vitest';
import { language } from '../src/core/language';
import type { CameraState, MachineCamera } from '../src/machine/api';
import { cameraWords, offsetFrom, stillAddress, streamAddress, turnOf, underCrossHair } from '../src/machine/camera';
import { token } from '../src/machine/token';

afterEach(() => {
  language.value = 'en';
  token.value = '';
});

const live: CameraState = { state: 'live', age: 0.1, problem: '', problem_sentence: { code: '', arguments: {} } };
const silent: CameraState = { ...live, state: 'waiting', problem: 'the camera sends no pictures', problem_sentence: { code: 'camera.silent', arguments: {} } };

describe('the state of the camera', () => {
  it('is silent while pictures come, and where there is no camera', () => {
    expect([live, null, undefined].map(cameraWords)).toEqual(['', '', '']);
    expect(cameraWords({ ...live, age: 1.9 })).toBe('');
  });

  it('tells for how long no picture has come, and why', () => {
    expect(cameraWords({ ...live, age: 3.7 })).toBe('No picture for 3 s');
    expect(cameraWords({ ...silent, age: 12.2 })).toBe('No picture for 12 s: the camera sends no pictures. Trying again.');
    expect(cameraWords({ ...silent, age: null })).toBe('No picture: the camera sends no pictures. Trying again.');
    expect(cameraWords({ ...live, state: 'connecting', age: null })).toBe('Connecting to the camera…');
    expect(cameraWords({ ...live, state: 'off', age: 600 })).toBe('Connecting to the camera…');
  });

  it('is told in the language of the page', () => {
    language.value = 'it';
    expect(cameraWords({ ...silent, age: 12.2 })).toBe('Nessuna immagine da 12 s: la telecamera non invia immagini. Nuovo tentativo in corso.');
  });
});

describe('the addresses', () => {
  it('carry the token, which no header can for a picture', () => {
    expect(streamAddress(0)).toBe('api/v1/camera/stream?attempt=0');
    expect(stillAddress(7)).toBe('api/v1/history/stills/7');
    token.value = 'a+b&c';
    expect(streamAddress(2)).toBe('api/v1/camera/stream?attempt=2&token=a%2Bb%26c');
    expect(stillAddress(7)).toBe('api/v1/history/stills/7?token=a%2Bb%26c');
  });
});

describe('the cross-hair', () => {
  const camera: MachineCamera = { offset: { x: 30, y: -12.5 }, rotation: 90, mirrored: false };

  it('is at the offset from the spindle', () => {
    expect(underCrossHair(camera, { x: 10, y: 5, z: -3 })).toEqual({ x: 40, y: -7.5 });
    expect(underCrossHair(camera, {})).toEqual({ x: 30, y: -12.5 });
  });

  it('gives the offset when it is over the dot that the spindle has made', () => {
    const dot = { x: 100, y: 50, z: -2 };
    const looks = { x: 70.0004, y: 62.5, z: 0 };
    expect(offsetFrom(dot, looks)).toEqual({ x: 30, y: -12.5 });
    expect(underCrossHair({ ...camera, offset: offsetFrom(dot, looks) }, looks)).toEqual({ x: 100.0004, y: 50 });
  });

  it('stays in the middle of a picture that is mirrored, rotated and magnified', () => {
    expect(turnOf(camera, 2)).toBe('scale(2) rotate(90deg)');
    expect(turnOf({ ...camera, rotation: 0, mirrored: true }, 1)).toBe('scale(1) rotate(0deg) scaleX(-1)');
  });
});
