// How much of something is done: a bar.
export function ProgressBar({ share, name }: { share: number; name: string }) {
  const percent = 100 * share;
  return (
    <div class="bar" role="progressbar" aria-label={name} aria-valuemin={0} aria-valuemax={100} aria-valuenow={Math.floor(percent)}>
      <i style={{ width: `${percent}%` }} />
    </div>
  );
}
