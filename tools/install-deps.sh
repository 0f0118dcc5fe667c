#!/bin/sh
# Installs the Debian 12 packages that scarp is built with, where one is missing; does nothing where all are there.
#   tools/install-deps.sh         what building, running and testing need
#   tools/install-deps.sh --ci    what the checks of .ci/run need as well
#   tools/install-deps.sh --bench what `make bench` needs as well
#   tools/install-deps.sh --fuzz  what `make fuzz` needs as well: libFuzzer and clang's sanitizers
set -eu

packages="
g++ gfortran cmake make
libgomp1
libtomlplusplus-dev
libcli11-dev
libspdlog-dev
libfmt-dev
libxsimd-dev
nlohmann-json3-dev
libeigen3-dev
libhdf5-dev
libxxhash-dev
libgtest-dev
librapidcheck-dev
python3 python3-numpy python3-matplotlib
"
case "${1:-}" in
  "") ;;
  --ci) packages="$packages libbenchmark-dev clang-14 libomp-14-dev clang-format-14 git ninja-build python3-h5py" ;;
  --bench) packages="$packages libbenchmark-dev" ;;
  --fuzz) packages="$packages clang-14 libclang-rt-14-dev" ;;
  *)
    echo "usage: tools/install-deps.sh [--ci | --bench | --fuzz]" >&2
    exit 2
    ;;
esac

missing=""
for package in $packages; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" != 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "tools/install-deps.sh: these packages are missing:$missing" >&2
    echo "  run it as root, or install them with: apt-get install$missing" >&2
    exit 1
  fi
  as_root="sudo"
fi
echo "installing:$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get -o DPkg::Lock::Timeout=300 update -qq
# shellcheck disable=SC2086  # a list of names
$as_root apt-get -o DPkg::Lock::Timeout=300 install -y -qq --no-install-recommends $missing
