#!/usr/bin/env bash
# scripts/install.sh [--build]: installs the Debian packages that Passo needs and that are missing.
#
#   --build   only what building and running needs; without it also what the tests and checks need
#
# It says what it does, does nothing else, and uses the network only where something is missing.
set -euo pipefail

# Debian 12 has a libc++ for WebAssembly that suits its clang only in version 16. Later releases have one of clang's version.
release=$(. /etc/os-release 2>/dev/null && echo "${VERSION_CODENAME-}") || release=
case "$release" in
  bookworm)
    wasm_packages=(libc++-16-dev-wasm32 libc++abi-16-dev-wasm32 libclang-rt-14-dev-wasm32)
    sanitizers=libclang-rt-14-dev
    ;;
  *)
    wasm_packages=(libc++-dev-wasm32 libclang-rt-dev-wasm32)
    sanitizers=libclang-rt-dev
    ;;
esac

build_packages=(
  g++ cmake ninja-build      # compiler and build
  libfmt-dev                 # text
  libcli11-dev               # command line
  libtomlplusplus-dev        # machine files
  nlohmann-json3-dev         # reports
  libcairo2-dev libpng-dev   # pictures
  libjpeg62-turbo-dev        # photographs for passo cam relief
  zlib1g-dev                 # packed TIFF pictures
  libsqlite3-dev             # jobs and history of passo serve
  libboost-dev               # HTTP and WebSocket of passo serve
  libmosquitto-dev           # status of passo serve for an MQTT broker
  libmodbus-dev              # spindle drives on RS-485
  libpolyclipping-dev        # unions and offsets of copper in passo cam
  libfreetype-dev libharfbuzz-dev libfontconfig-dev  # letters in passo cam engrave
  libexpat1-dev              # SVG drawings in passo cam
  libyaml-cpp-dev            # FluidNC configurations in passo machine --from
  libminizip-dev             # zip archives of board files, 3MF models
  pybind11-dev python3-pybind11 python3-dev python3-numpy  # the Python package
  fonts-dejavu-core          # letters in pictures
  clang gcc-avr avr-libc binutils-avr  # the firmware for the Uno and the Mega: compiler; libgcc, start-up code, linker
  lld wasi-libc "${wasm_packages[@]}"  # the lab of the page, as WebAssembly
  libsimavr-dev libelf-dev   # passo-emulate-avr runs it on emulated chips: sim:uno, sim:mega
)
test_packages=(
  libgtest-dev libgmock-dev  # tests
  libbenchmark-dev           # benchmarks
  "$sanitizers"              # sanitizers and fuzzers of clang
  avrdude arduino-core-avr   # writes to a chip; the Uno's boot loader, which the tests put on the emulated chip
  gputils gpsim              # assembler and emulator for the PIC
  clang-format clang-tidy    # style
  git ccache                 # checks of the tracked files; builds again in seconds
  gerbv                      # draws circuit boards beside passo's reader
  libpq-dev libsodium-dev pkg-config postgresql  # the store of a farm, which only tests use yet; a server for them
  mosquitto                  # a broker for the tests of passo serve --mqtt
  bcnc xvfb xdotool imagemagick  # a sender, its screen, its keys and its pictures, for the tests of passo serve
  python3-ezdxf librecad-data openscad-testing-data  # reads DXF drawings beside passo's reader; 1,368 drawings
  potrace                    # traces pictures for passo cam engrave --trace
  jq                         # the table of scripts/motion_table.sh
  curl netcat-openbsd        # a web page's request to the sender port of passo serve
  chromium                   # the stories of the page of passo serve
  mkdocs-material python3-markdown-it python3-jieba  # the site; its search divides Chinese words
  mypy python3-build python3-setuptools python3-wheel  # types and wheel of the Python package
  debhelper dh-python lintian debootstrap  # Debian packages, their check, and a bare system to install them in
)

# The page of passo serve is built with node, 18 or later, and the Pico's emulator, rp2040js, runs on it. A node from
# elsewhere brings its own npm.
command -v node >/dev/null || build_packages+=(nodejs)
command -v npm >/dev/null || build_packages+=(npm)
pico_emulator=$(dirname "${BASH_SOURCE[0]}")/../src/board/emulator/pico
fetch_pico_emulator() {
  [[ ${1-} != --build ]] || return 0
  # The lock file names the version and the sum of what it fetches.
  cmp --silent "$pico_emulator/package-lock.json" "$pico_emulator/node_modules/.passo-lock" && return 0
  echo "+ npm ci in src/board/emulator/pico"
  if ! npm ci --prefix "$pico_emulator" --ignore-scripts --no-audit --no-fund --silent; then
    echo "The Pico's emulator could not be fetched: its tests are skipped, and sim:pico is refused." >&2
    return 0
  fi
  cp "$pico_emulator/package-lock.json" "$pico_emulator/node_modules/.passo-lock"
}

packages=("${build_packages[@]}")
case "${1-}" in
  --build) ;;
  "") packages+=("${test_packages[@]}") ;;
  *)
    sed -n '2,6s/^# \{0,1\}//p' "$0"
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "This is not Debian or a relative of it. Passo needs what Debian 12 calls:" >&2
  echo "  ${packages[*]}" >&2
  echo "Install the like of them; then CONTRIBUTING.md tells how to build." >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  # shellcheck disable=SC2016  # the braces are dpkg-query's
  state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) || state=none
  [[ $state == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "All ${#packages[@]} packages are installed."
  fetch_pico_emulator "$@"
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "Not root, and there is no sudo. As root, run:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

run() {
  echo "+ $*"
  "$@"
}
# Another program may use apt, such as the updates of a fresh system. DPkg::Lock::Timeout waits for the packages; nothing
# waits for the lists.
update_lists() {
  local said
  echo "+ ${as_root[*]:+${as_root[*]} }apt-get update"
  for _ in {1..120}; do
    said=$("${as_root[@]}" env LC_ALL=C apt-get update --quiet 2>&1) && echo "$said" && return
    [[ $said == *"Could not get lock"* ]] || break
    echo "Another program uses apt. Waiting for it."
    sleep 5
  done
  echo "$said" >&2
  return 1
}
echo "Missing: ${missing[*]}"
update_lists
run "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -o DPkg::Lock::Timeout=600 --yes --quiet --no-install-recommends "${missing[@]}"
echo "Installed: ${missing[*]}"
fetch_pico_emulator "$@"
