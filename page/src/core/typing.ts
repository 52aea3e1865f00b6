// Keys that go to a field are meant for the field.
export function isTyping(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && target.closest('input, textarea, select, [contenteditable]') !== null;
}

// Of a field for text a blank is a part. Elsewhere the space bar only chooses or presses something.
export function takesText(target: EventTarget | null): boolean {
  const choices = ['radio', 'checkbox', 'range', 'button', 'file'];
  const field = target instanceof HTMLElement ? target.closest('input, textarea, [contenteditable]') : null;
  return field !== null && !(field instanceof HTMLInputElement && choices.includes(field.type));
}
