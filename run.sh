#!/usr/bin/env bash
# Everything from a bare Debian or Ubuntu to a result: see usage below, or ./run.sh help.
set -euo pipefail

root="$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)"
build="$root/build/release"

# Debian's names; the comment says what needs it.
packages=(
  g++ cmake ninja-build   # build
  libeigen3-dev           # dense algebra
  libsuitesparse-dev      # sparse Cholesky factor
  libmetis-dev            # its ordering
  libopenblas-dev         # its kernels, five to ten times faster than the reference BLAS
  libgmsh-dev             # meshes
  libseccomp-dev          # what keeps gmsh from doing more than that
  liblua5.4-dev           # decks
  libcli11-dev            # command line
  libspdlog-dev           # messages
  nlohmann-json3-dev      # run record
  libgtest-dev            # tests
  libbenchmark-dev        # timings
  libopenmpi-dev openmpi-bin  # runs on several ranks; without it they are not built
)
# Files for ParaView. Where it is not installed, its headers are unpacked into build/vtk, and its libraries (see vtk_library) are
# installed: it needs python3-vtk9, which excludes ParaView's python3-paraview, so that apt would take one of both away.
vtk_package=libvtk9-dev
vtk_root="$root/build/vtk"
test_packages=(
  clang-format-14         # are the sources formatted as agreed
  python3                 # runs are killed and continued by scripts
  chromium                # a report is opened in it; 350 MB
)
fuzz_packages=(clang libclang-rt-dev llvm)    # of ./run.sh fuzz and ./run.sh sanitize threads
report_packages=(python3 python3-numpy python3-matplotlib)  # of ./run.sh report and ./run.sh bench
manual_packages=(mkdocs mkdocs-material)                    # of ./run.sh manual

usage() {
  cat <<'END'
./run.sh                  install what is missing, build the program, run decks/bolted_flanges.lua, say which files to open
./run.sh test [NAME]      install what is missing, build the program and its tests, pass them; with NAME only those whose name matches it (ctest -R)
./run.sh test --all       the slow ones too (label 'slow' in tests/CMakeLists.txt): decks against refined or converged answers
./run.sh sanitize [decks] build with address and undefined behaviour sanitizers (build/sanitize), pass the unit tests and run small decks;
                          'threads': small decks on three threads under the sanitizer of threads (clang, build/threads)
                          'decks': these and a minute of the fuzzers, which needs the program and them alone
./run.sh fuzz [NAME [MINUTES]]  tests/fuzz with libFuzzer under sanitizers (clang): NAME or 'all', a minute each; finds are in build/fuzz/found
./run.sh random MINUTES [--seed S]  random scenes against what must be so of any (tests/random): turned, mirrored, cut, continued, by another solver, ...;
                          what fails is shrunk to a small deck in build/random
./run.sh bench [...]      measure speed, rewrite manual/performance.md and its figures: all, or of the parts headline kernels
                          scenes statics scaling ensembles ranks those that are named; --quick: small sizes. Full: 27 minutes on a machine left alone.
                          Elsewhere, --up-to UNKNOWNS --into DIR; put beside as manual/performance/others/NAME, --page shows it
./run.sh report [...]     run all verification, rewrite manual/verification.md and its figures (--quick, --only CASE)
./run.sh manual           install what is missing, build the manual as a site with search in build/manual
./run.sh build            install what is missing, build
./run.sh install          install what is missing, no more; no package is ever removed
./run.sh run DECK [...]   build if needed, then: dygita run DECK [...]    (--set NAME=VALUE, --out DIR, --threads N)
./run.sh help             this

Packages come from apt, with sudo when you are not root; nothing is installed when all is there.
DYGITA_NO_INSTALL=1 never installs, for a system where the libraries come from elsewhere.
The program is build/release/dygita afterwards. Other builds (debug, sanitize, clang): cmake --list-presets
END
}

say() { printf '\n== %s\n' "$*"; }
fail() {
  printf '\nrun.sh: %s\n' "$1" >&2
  shift
  (($# == 0)) || printf '    %s\n' "$@" >&2
  exit 1
}

is_installed() { [[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" == installed* ]]; }

missing_packages() {
  local package
  for package in "${packages[@]}"; do
    is_installed "$package" || echo "$package"
  done
}

# Is VTK installed for development, or are its headers unpacked here and the libraries of that version there?
has_vtk() {
  [[ -n "$vtk_package" ]] || return 0 # not wanted
  is_installed "$vtk_package" && return
  local headers
  headers="$(compgen -G "$vtk_root/usr/include/vtk-9.*")" || return
  compgen -G "/usr/lib/*/libvtkIOXML-${headers##*vtk-}.so.*" >/dev/null
}

# The package of VTK's libraries, which has the version in its name: libvtk9.1, libvtk9.1t64.
vtk_library() { apt-cache depends "$vtk_package" | sed -nE 's/^ *Depends: (libvtk9\.[0-9]+(t64)?)$/\1/p'; }

unpack_vtk() {
  say "Unpacking VTK's headers into build/vtk"
  rm -rf "$vtk_root"
  mkdir -p "$vtk_root"
  (cd "$vtk_root" && apt-get download "$vtk_package" && dpkg -x "$vtk_package"_*.deb . && rm "$vtk_package"_*.deb) ||
    fail "apt-get could not fetch $vtk_package; its own message is above"
}

as_root() {
  if ((EUID == 0)); then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

install_packages() {
  [[ "${DYGITA_NO_INSTALL:-0}" != 1 ]] || return 0
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    fail "this is not Debian or Ubuntu: there is no apt-get" \
      "install what these packages are called on your system, then DYGITA_NO_INSTALL=1 $0:" "${packages[*]} $vtk_package"
  fi
  local missing
  mapfile -t missing < <(missing_packages)
  local needs_vtk=0
  has_vtk || needs_vtk=1
  if ((${#missing[@]} + needs_vtk == 0)); then
    say "Every package that is needed is installed"
    return 0
  fi

  if ((EUID != 0)) && ! command -v sudo >/dev/null; then
    fail "installing needs root and there is no sudo: as root run" \
      "apt-get update && apt-get install --no-install-recommends ${missing[*]} $( ((needs_vtk == 0)) || vtk_library)"
  fi
  # A mirror that is down for one list need not stop the rest: what matters is whether the packages install.
  as_root apt-get update || printf 'run.sh: apt-get update failed, trying with the package lists at hand\n' >&2
  if ((needs_vtk)); then mapfile -t -O "${#missing[@]}" missing < <(vtk_library); fi
  say "Installing ${#missing[@]} packages (VTK and what it depends on is by far the largest, some minutes):"
  printf '    %s\n' "${missing[@]}"
  # --no-remove: what is installed stays, whatever apt would give up for ours.
  as_root apt-get install -y --no-install-recommends --no-remove "${missing[@]}" ||
    fail "apt-get could not install the packages, or not without removing others; its own message is above" \
      "needed: ${missing[*]}" "is there a network, and does the system (Debian 12, Ubuntu 24.04 or later) have them?"
  ((needs_vtk == 0)) || unpack_vtk
}

# What only some tests need: they are skipped where it is not to be had.
install_test_packages() {
  [[ "${DYGITA_NO_INSTALL:-0}" != 1 ]] || return 0
  local package
  for package in "${test_packages[@]}"; do
    is_installed "$package" && continue
    if apt-cache show "$package" >/dev/null 2>&1 && as_root apt-get install -y --no-install-recommends --no-remove "$package"; then continue; fi
    say "There is no package '$package' here: the tests that need it are skipped"
  done
}

# One compiler takes up to about 1.5 GB with these headers.
n_jobs() {
  local cores memory
  cores="$(nproc)"
  memory="$(awk '/^MemAvailable/ { print int($2 / 2e6) }' /proc/meminfo 2>/dev/null || true)"
  memory="${memory:-$cores}"
  ((memory > 0)) || memory=1
  echo $((memory < cores ? memory : cores))
}

# The program, or with 'all' its tests too.
build_engine() {
  # A build folder that came along with a copied checkout belongs to another place.
  local cache="$build/CMakeCache.txt"
  if [[ -f "$cache" ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    say "build/release was configured for another folder: configuring anew"
    rm -rf "$build"
  fi
  say "Building (build/release)"
  (cd "$root" && cmake --preset release && cmake --build --preset release --parallel "$(n_jobs)" --target "${1:-dygita}") ||
    fail "the build failed; the first error is above"
}

# The tests whose name matches $1, all with --all, or all but the slow ones.
run_tests() {
  local chosen=(-LE slow)
  case "${1:-}" in
    "") ;;
    --all) chosen=() ;;
    *) chosen=(-R "$1") ;;
  esac
  say "Testing"
  # One more than there are cores: several tests wait for ranks, signals or a browser.
  (cd "$root" && ctest --preset release --parallel "$(($(nproc) + 1))" "${chosen[@]}") ||
    fail "tests failed; the last lines above name them" "one of them again: ./run.sh test NAME"
}

# Decks' tests are left out: they take the sanitizers long, and their parts are all in the unit tests.
run_sanitized() {
  local preset=sanitize targets=(dygita unit_tests) tests=(-L unit)
  case "${1:-}" in
    "") ;;
    threads) preset=threads targets=(dygita test_base) tests=(-R '^(ParallelFor.*|small_decks_run_with_threads)$') ;;
    decks) targets=(dygita fuzzers) tests=(-R '^(small_decks_run|fuzz_(table|state|folder|answer|cad|deck)_.*)$') ;;
    *) fail "'sanitize' takes nothing, 'decks' or 'threads', got: $1" "./run.sh help" ;;
  esac
  say "Building with sanitizers (build/$preset)"
  (cd "$root" && cmake --preset "$preset" && cmake --build --preset "$preset" --parallel "$(n_jobs)" --target "${targets[@]}") ||
    fail "the build failed; the first error is above"
  say "Testing with sanitizers"
  (cd "$root" && ctest --preset "$preset" --parallel "$(nproc)" "${tests[@]}") ||
    fail "tests failed with sanitizers; the last lines above name them"
}

# What leads further stays in build/fuzz/corpus for the next time; tests/fuzz/corpus has what is kept for good.
run_fuzz() {
  local asked="${1:-all}" seconds=$((60 * ${2:-1})) known=() failed=() name
  mapfile -t known < <(cd "$root/tests/fuzz/corpus" && printf '%s\n' * run | sort)
  [[ "$asked" == all || " ${known[*]} " == *" $asked "* ]] || fail "no fuzzer '$asked'; known: ${known[*]}"
  say "Building the fuzzers (build/fuzz)"
  [[ "$asked" == all ]] || known=("$asked")
  (cd "$root" && cmake --preset fuzz && cmake --build --preset fuzz --parallel "$(n_jobs)" --target "${known[@]/#/fuzz_}") ||
    fail "the build failed; the first error is above"
  for name in "${known[@]}"; do
    local corpus="$root/build/fuzz/corpus/$name" found="$root/build/fuzz/found/$name" kept="$root/tests/fuzz/corpus/${name/#run/deck}"
    mkdir -p "$corpus" "$found"
    say "Fuzzing '$name' for $((seconds / 60)) minutes"
    (cd "$found" && ASAN_OPTIONS=alloc_dealloc_mismatch=0 UBSAN_OPTIONS=print_stacktrace=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 \
      LSAN_OPTIONS="suppressions=$root/cmake/leaks.supp:print_suppressions=0" "$root/build/fuzz/tests/fuzz_$name" \
      -close_fd_mask=1 -print_funcs=0 -timeout=100 -rss_limit_mb=2500 -malloc_limit_mb=1500 -max_len=20000 -print_final_stats=1 \
      "-max_total_time=$seconds" "-artifact_prefix=$found/" "$corpus" "$kept") || failed+=("$name")
  done
  ((${#failed[@]} == 0)) || fail "found by: ${failed[*]}" "the inputs are in build/fuzz/found/NAME, the reports above"
}

run_random() {
  local minutes="${1:-}" mpirun=()
  [[ "$minutes" =~ ^[0-9]+([.][0-9]+)?$ ]] || fail "'random' takes minutes and options of tests/random/random_scenes.py, got: $*" "./run.sh random 10 --seed 7"
  shift
  ! command -v mpirun >/dev/null || mpirun=(--mpirun "$(command -v mpirun)")
  (cd "$root" && python3 -B tests/random/random_scenes.py "$build/dygita" --minutes "$minutes" "${mpirun[@]}" "$@") ||
    fail "relations failed; their decks are named above"
}

run_bench() {
  local python=/usr/bin/python3 # Debian's has the packages; another one in PATH may not
  [[ -x "$python" ]] || python=python3
  say "Performance: compare as ratios within one run; leave the machine alone meanwhile"
  (cd "$root" && cmake --build --preset release --target bench_linear bench_kernels) || fail "the benchmarks failed to build"
  (cd "$root" && "$python" manual/performance/bench.py "$@")
}

run_report() {
  local python=/usr/bin/python3 # Debian's has the packages; another one in PATH may not
  [[ -x "$python" ]] || python=python3
  say "Verification: all cases, figures and tables"
  (cd "$root" && cmake --build --preset release --target effectivity) || fail "the study of error estimates failed to build"
  (cd "$root" && "$python" manual/verification/report.py "$@")
}

build_manual() {
  say "The manual"
  (cd "$root" && mkdocs build --strict --clean) || fail "mkdocs failed; its own message is above"
  say "Open $root/build/manual/index.html (the search needs a server: python3 -m http.server --directory build/manual)"
}

run_example() {
  local deck=decks/bolted_flanges.lua results=out/bolted_flanges/base status=0 file
  say "Running $deck"
  (cd "$root" && "$build/dygita" run "$deck") || status=$?
  ((status <= 1)) || fail "dygita stopped with exit code $status; its message is above"
  ((status == 0)) || say "The run finished, but some steps did not reach their tolerance (exit code 1)"
  say "Results are in $root/$results"
  if [[ -f "$root/$results/bolted_flanges.pvd" ]]; then
    echo "    paraview $root/$results/bolted_flanges.pvd      the flanges through time; Warp By Vector, displacement, x20"
  fi
  for file in "$root/$results"/{report.html,interfaces.pvd,run.json,*.csv}; do
    [[ ! -f "$file" ]] || echo "    $file"
  done
  echo
  echo "Next: ./run.sh run decks/crush.lua --set mu=0.6"
  return "$status"
}

main() {
  local command="${1:-example}"
  (($# == 0)) || shift
  case "$command" in
    help | -h | --help) usage ;;
    install) install_packages ;;
    example | test | build | sanitize)
      local taken=0
      [[ "$command" != test && "$command" != sanitize ]] || taken=1 # NAME, or 'decks'
      (($# <= taken)) || fail "'$command' takes ${taken/#0/no} argument, got: $*" "./run.sh help"
      [[ "$command $*" != "sanitize threads" ]] || packages+=("${fuzz_packages[@]}")
      install_packages
      [[ "$command" != test ]] || install_test_packages
      case "$command" in
        test) build_engine all ;;
        example | build) build_engine ;;
      esac
      case "$command" in
        example) run_example ;;
        test) run_tests "$@" ;;
        build) say "Built: $build/dygita" ;;
        sanitize) run_sanitized "$@" ;;
      esac
      ;;
    fuzz)
      (($# <= 2)) && [[ "${2:-1}" =~ ^[0-9]+$ ]] || fail "'fuzz' takes a name and minutes, got: $*" "./run.sh help"
      packages+=("${fuzz_packages[@]}")
      install_packages
      run_fuzz "$@"
      ;;
    random)
      packages+=(python3)
      install_packages
      build_engine
      run_random "$@"
      ;;
    report | bench)
      packages+=("${report_packages[@]}")
      install_packages
      build_engine
      "run_$command" "$@"
      ;;
    manual)
      (($# == 0)) || fail "'manual' takes no argument, got: $*" "./run.sh help"
      packages=("${manual_packages[@]}") vtk_package=
      install_packages
      build_manual
      ;;
    run)
      (($# > 0)) || fail "'run' needs a deck: ./run.sh run DECK [--set NAME=VALUE ...]"
      [[ -f "$1" ]] || fail "there is no deck '$1' in $PWD"
      install_packages
      build_engine
      say "Running $1"
      exec "$build/dygita" run "$@"
      ;;
    *) fail "unknown command '$command'; known: bench, build, fuzz, help, install, manual, random, report, run, sanitize, test" "./run.sh help" ;;
  esac
}

main "$@"
