#!/usr/bin/env bash
# scripts/container_test.sh [--chroot | --save FILE]: builds the container of Containerfile on a bare Debian 12, and tries it:
# not root, on a read-only file system, with a volume. It runs a first job, then the server, whose health, token and page
# are checked.
#
#   --chroot   without podman, which need not be here: the steps of the Containerfile are done in a chroot
#   --save     then writes the image into FILE, a tar.gz for `podman load` and `docker load`
#
# PASSO_PODMAN is the command instead of podman, such as "podman --runtime /usr/sbin/runc"; PASSO_PODMAN_RUN has further
# options of its command run, such as "--ulimit nproc=20000:20000", for computers that are containers themselves.
# Exit code 77, "skipped": not root, no podman, no bare Debian (scripts/bare_debian.sh), no packages, or no namespaces.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

skip() {
  echo "$1" >&2
  exit 77
}
fail() {
  echo "scripts/container_test.sh: $1" >&2
  exit 1
}
way=podman
case "${1-}" in
  "" | --save) command -v podman >/dev/null || skip "podman is not installed." ;;
  --chroot) way=chroot ;;
  *)
    sed -n '2,11s/^# \{0,1\}//p' "$0"
    exit 2
    ;;
esac
[[ $EUID == 0 ]] || skip "Only root can enter a bare system."
unshare --mount true 2>/dev/null || skip "Namespaces are not allowed here."
[[ -n ${PASSO_IN_NAMESPACE-} ]] || PASSO_IN_NAMESPACE=1 exec unshare --mount "$PWD/scripts/container_test.sh" "$@"
arch=$(dpkg --print-architecture)
packages=(build/packages/passo_*_"$arch".deb)
[[ -f ${packages[0]} ]] || skip "There are no packages: run scripts/package.sh."

root=$(mktemp -d /tmp/passo-root.XXXXXX)
volume=$(mktemp -d /tmp/passo-volume.XXXXXX)
server=
trap '[[ -z $server ]] || kill "$server"; umount -R "$root" && rm -r "$root" "$volume"' EXIT
mount -t tmpfs tmpfs "$root" || skip "Nothing can be mounted here."
# The libraries of the packages, as in scripts/package_test.sh, whose bare system is used here again.
mapfile -t needed < <(scripts/package_needs.sh build/packages/passo_*.deb build/packages/passo-emulators_*.deb)
scripts/bare_debian.sh bookworm "$arch" "$root" "${needed[@]}" || exit
# As in the images of Debian: without documents and translations.
rm -rf "$root"/usr/share/{doc,man,locale}/* "$root"/var/lib/apt/lists/* "$root"/var/cache/apt/* "$root"/var/log/*
image=passo-test name=
read -ra podman <<<"${PASSO_PODMAN:-podman}"
read -ra run_options <<<"${PASSO_PODMAN_RUN-}"
port=$((20000 + RANDOM % 10000))

# The same packages give the same layers of the image.
epoch=$(dpkg-parsechangelog --file debian/changelog --show-field Timestamp)
build_by_podman() {
  # Not by `podman import`, which writes the time into the image.
  tar --create --one-file-system --sort=name --mtime="@$epoch" --directory "$root" --file "$volume/bare.tar" .
  printf 'FROM scratch\nADD bare.tar /\n' >"$volume/Containerfile"
  "${podman[@]}" build --quiet --timestamp "$epoch" --tag passo-bare "$volume" >/dev/null
  rm "$volume/bare.tar" "$volume/Containerfile"
  "${podman[@]}" build --quiet --isolation chroot --format docker --pull=never --build-arg BASE=localhost/passo-bare \
    --timestamp "$epoch" --tag "$image" . >/dev/null
  size=$("${podman[@]}" image inspect --format '{{.Size}}' "$image")
}
run_by_podman() {  # ARGUMENT...
  exec "${podman[@]}" run --rm --network host --read-only --read-only-tmpfs=false --security-opt no-new-privileges --cap-drop all \
    --volume "$volume:/var/lib/passo:U" --env "PASSO_PORT=$port" "${run_options[@]}" ${name:+--name "$name"} "$image" "$@"
}
health_by_podman() {
  "${podman[@]}" healthcheck run "$name" >/dev/null
}

# The second stage of the Containerfile, instruction by instruction.
environment=(PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
build_by_chroot() {
  local instruction rest
  mkdir "$root/packages"
  cp "${packages[@]}" "$root/packages/"
  while read -r instruction rest; do
    case "$instruction" in
      RUN) chroot "$root" sh -c "${rest#--mount=* }" >build/packages/container.log 2>&1 ||
        fail "this fails, see build/packages/container.log: $rest" ;;
      COPY) install -D "${rest% *}" "$root${rest#* }" ;;
      ENV) read -ra words <<<"$rest" && environment+=("${words[@]}") ;;
      USER) user=$rest ;;
      ENTRYPOINT) entry=$(tr -d '[]"' <<<"$rest") ;;
    esac
  done < <(sed -e ':a' -e '/\\$/N; s/\\\n */ /; ta' Containerfile | sed -e '/^#/d' -e '1,/^RUN/d')
  rm -r "$root/packages"
  size=$(du --bytes --summarize --one-file-system "$root" | cut -f1)
  chown "$(chroot "$root" id -u "$user")":"$(chroot "$root" id -g "$user")" "$volume"
  mount -t proc proc "$root/proc"
  mount --bind /dev "$root/dev"
  mount -o remount,ro "$root"
  mount --bind "$volume" "$root/var/lib/passo"
}
run_by_chroot() {  # ARGUMENT...; it becomes the program
  exec chroot "$root" setpriv --reuid "$user" --regid "$user" --init-groups --no-new-privs --bounding-set=-all --inh-caps=-all \
    env --ignore-environment "${environment[@]}" "PASSO_PORT=$port" "$entry" "$@"
}

health_by_chroot() {
  (run_by_chroot health)
}

begun=$(date +%s%N)
ends() {  # STEP
  local now
  now=$(date +%s%N)
  printf '%-34s %6.1f s\n' "$1" "$(((now - begun) / 100000000))e-1"
  begun=$(date +%s%N)
}
"build_by_$way"
ends "container built by $way, $((size / 1000000)) MB"
((size < 200000000)) || fail "the container has $size bytes, more than 200 MB"

examples=/usr/share/passo/examples
("run_by_$way" run --yes "$examples/engrave.ngc" --machine "$examples/machines/pantograph.toml" \
  --picture /var/lib/passo/engrave.png -q) || fail "the first job fails"
[[ -s $volume/engrave.png ]] || fail "the first job wrote no picture"
ends "first job"

name=$image
"run_by_$way" >build/packages/container.log 2>&1 &
server=$!
for _ in {1..100}; do
  "health_by_$way" 2>/dev/null && break
  sleep 0.1
done
"health_by_$way" || fail "the server is not healthy: see build/packages/container.log"
page=http://127.0.0.1:$port
token=$(cat "$volume/token")
answers() {  # STATUS PATH [OPTION...]
  local status
  status=$(curl --silent --output /dev/null --write-out '%{http_code}' "${@:3}" "$page$2")
  [[ $status == "$1" ]] || fail "$2 answers $status, not $1"
}
answers 200 /
answers 401 /api/v1/status
answers 200 /api/v1/status --header "Authorization: Bearer $token"
grep -q "#token=$token" build/packages/container.log || fail "the container does not say how to open its page"
who=$(stat --format %U:%a "$volume/token")
[[ $who != root:* && $who == *:600 ]] || fail "the token is readable by others: $who"
kill -TERM "$server"
wait "$server" || true
server=
[[ -s $volume/jobs.sqlite ]] || fail "the server kept no jobs"
ends "server: health, token, page"
if [[ ${1-} == --save ]]; then
  "${podman[@]}" save --quiet "$image" | gzip -9n >"${2:?the file}.unfinished"
  mv "$2.unfinished" "$2"
  ls -l "$2"
fi
