# Sourced by tools/start and tools/test: packages, configuration, build.
# Exit statuses are those of casimir itself; 4 means that the environment is at fault.
# shellcheck shell=bash
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=$root/build
logs=$build/logs

# What casimir itself needs; tools/test adds to it.
# shellcheck disable=SC2034
packages=(g++ cmake ninja-build pkg-config gnuplot-nox
  libginac-dev libcln-dev libeigen3-dev libflint-dev libflint-arb-dev
  libtomlplusplus-dev libcli11-dev
  nlohmann-json3-dev libfmt-dev libsodium-dev libsundials-dev libboost-dev libzip-dev)
# Those that the tests need besides.
test_packages=(libgtest-dev clang coq doxygen zsh fish man-db mandoc bsdextrautils lintian dpkg-dev fakeroot file
  chromium-headless-shell libopenmpi-dev openmpi-bin libhdf5-dev hdf5-tools
  python3-dev pybind11-dev python3-numpy python3-scipy python3-sympy python3-matplotlib python3-jsonschema python3-pip)

say() { printf '%s\n' "$*"; }
heading() { printf '\n== %s\n\n' "$*"; }

# fail STATUS TEXT..: one line for each text, and out.
fail() {
  local status=$1
  shift
  printf '%s\n' "$@" >&2
  exit "$status"
}

# show_log LOG: what ninja says of the first step that failed, less its command line; or else the
# errors in it with the lines that follow; or else its end.
show_log() {
  if grep -q -m1 '^FAILED: ' "$1"; then
    awk '/^FAILED: / {if (shown++) exit; print; getline; next} /^\[[0-9]+\// && shown {exit}
         shown && lines++ < 40 {print substr($0, 1, 300)}' "$1" >&2
  elif grep -q -m1 -E '(error:|Error at|^E: )' "$1"; then
    grep -E -A4 '(error:|Error at|^E: )' "$1" | head -n 40 >&2
  else
    tail -n 20 "$1" >&2
  fi
  printf 'The whole log is %s\n' "$1" >&2
}

missing_packages() {
  local package installed
  installed=$(dpkg-query -W -f='${db:Status-Abbrev}${Package}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    grep -qxF "ii $package" <<<"$installed" || printf '%s\n' "$package"
  done
}

# The words to put before a command to run it as root; fails where there is no way.
as_root() {
  if [[ $(id -u) -eq 0 ]]; then
    printf 'env\n'
  elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [[ -t 0 && -t 2 ]]; }; then
    printf 'sudo\nenv\n'
  else
    return 1
  fi
}

new_packages=''  # yes: the build may find more than when it was configured

# install_packages NAME..: installs those that are missing; asks the network only then.
install_packages() {
  local -a missing prefix apt
  local by_hand log=$logs/install.log
  if ! command -v dpkg-query >/dev/null; then
    say "This is not Debian: taking the libraries to be there already."
    return
  fi
  mapfile -t missing < <(missing_packages "$@")
  [[ ${#missing[@]} -gt 0 ]] || return 0

  by_hand="apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
  mapfile -t prefix < <(as_root)
  if [[ ${#prefix[@]} -eq 0 ]]; then
    fail 4 "Packages are missing and this user cannot install them. Run this as root, then try again:" \
      "$by_hand"
  fi
  apt=("${prefix[@]}" DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  if ! { "${apt[@]}" update && "${apt[@]}" install -y --no-install-recommends "${missing[@]}"; } \
      </dev/null >"$log" 2>&1; then
    show_log "$log"
    fail 4 "Installing packages failed. By hand, as root:" "$by_hand"
  fi
  new_packages=yes
}

cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt" 2>/dev/null || true; }

# Whether warnings are errors: with the compiler that this is written with. tools/start and tools/test say the
# same, else one would compile everything again after the other.
warnings_are_errors() { [[ $(g++ -dumpversion 2>/dev/null) == 12* ]] && printf 'ON\n' || printf 'OFF\n'; }

# configure ON|OFF: with tests or without. Does nothing where the build folder already fits; tests
# that are configured stay so.
configure() {
  local tests=$1 log=$logs/configure.log
  local -a fresh=()
  [[ $(cached CASIMIR_TESTS) == ON ]] && tests=ON
  if [[ $(cached CMAKE_HOME_DIRECTORY) == "$root" && $(cached CMAKE_GENERATOR) == Ninja ]]; then
    if [[ -z $new_packages && -f $build/build.ninja && $(cached CMAKE_BUILD_TYPE) == Release &&
          $(cached CASIMIR_TESTS) == "$tests" ]]; then
      return
    fi
  else
    fresh=(--fresh)  # none yet, another generator, or a folder that has been moved
  fi
  say "Configuring (Release, tests $tests)"
  if ! cmake "${fresh[@]}" -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
      -DCASIMIR_TESTS="$tests" -DCASIMIR_WERROR="$(warnings_are_errors)" -DCASIMIR_QUICK_TESTS="$tests" -DCASIMIR_UNITY=ON >"$log" 2>&1; then
    show_log "$log"
    fail 1 "CMake could not configure the build."
  fi
}

# A compiler process takes up to 2.1 gigabytes, most of them less than two.
jobs() {
  local cores memory
  cores=$(nproc 2>/dev/null || echo 1)
  memory=$(awk '/^MemAvailable:/ {print int($2 / 2000000)}' /proc/meminfo 2>/dev/null || true)
  [[ -n $memory && $memory -lt $cores ]] && cores=$memory
  [[ $cores -ge 1 ]] || cores=1
  printf '%s\n' "$cores"
}

# Copies ninja's output to a file. Says so when there is work to do, which a dry run would not tell
# (it takes a folder to be checked for new files for a change); on a terminal also shows each step.
progress() {
  local log=$1 line announced=''
  while IFS= read -r line; do
    printf '%s\n' "$line" >&3
    [[ $line == \[[1-9]* ]] || continue
    [[ -n $announced ]] || say "Building (a few minutes the first time)"
    announced=yes
    [[ ! -t 1 ]] || printf '\r\033[K  %.76s' "$line"
  done 3>"$log"
  if [[ -n $announced && -t 1 ]]; then printf '\r\033[K'; fi
}

# compile TARGET: prints something only where there is work to do.
compile() {
  local target=$1 log=$logs/build.log
  if ! ninja -C "$build" -j "$(jobs)" "$target" 2>&1 | progress "$log"; then
    show_log "$log"
    fail 1 "The build failed."
  fi
}

# prepare ON|OFF TARGET PACKAGE..: everything up to a built TARGET.
prepare() {
  local tests=$1 target=$2
  shift 2
  cd "$root" || exit
  mkdir -p "$logs" 2>/dev/null || fail 4 "Cannot write to $build"
  [[ -w $logs ]] || fail 4 "Cannot write to $logs"
  install_packages "$@"
  configure "$tests"
  compile "$target"
}
