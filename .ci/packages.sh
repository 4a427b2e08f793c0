#!/usr/bin/env bash
# Installs the Debian packages for a purpose: .ci/packages.sh demo|test|checks
set -euo pipefail

library=(g++ cmake make libeigen3-dev libboost-dev)
examples=(libcli11-dev nlohmann-json3-dev)
case "${1:-}" in
    demo) wanted=("${library[@]}" "${examples[@]}" python3 python3-numpy python3-matplotlib) ;;
    test) wanted=("${library[@]}" "${examples[@]}" catch2 libbenchmark-dev) ;;
    checks) wanted=(clang clang-format clang-tidy) ;;
    *) echo "usage: $0 demo|test|checks" >&2; exit 2 ;;
esac

missing=()
for package in "${wanted[@]}"; do
    # dpkg -s alone also succeeds for a package that was removed but not purged.
    dpkg -s "$package" 2>/dev/null | grep -q '^Status: install ok installed' || missing+=("$package")
done
# Nothing to do is the usual case: then neither root nor the network is needed.
[ ${#missing[@]} -gt 0 ] || exit 0

echo "installing: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "install as root: apt-get install ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
fi
# Waits for another apt instead of failing: fresh machines often run one at boot.
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300)
"${apt[@]}" update
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null >/dev/null
