#!/usr/bin/env bash
# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes .venv from the lock and proves that Blender's module loads in it. The copy of the lock
# in .venv is the stamp: it is written last, so a broken run starts again and a second call
# returns at once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly lock=.ci/requirements.lock
readonly stamp=.venv/requirements.lock
readonly wanted=3.13

say() { printf 'setup: %s\n' "$*" >&2; }

fail() {
  say "$@"
  exit 1
}

# True when the command really runs and is the wanted Python: a pyenv shim may exist and not run.
is_wanted() {
  [[ -n $1 ]] && [[ $("$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null) == "$wanted" ]]
}

# Prints the command of the first Python of the wanted version.
find_python() {
  local candidate
  if command -v uv >/dev/null; then
    candidate=$(uv python find --no-project --system --no-python-downloads "$wanted" 2>/dev/null || true)
    if is_wanted "$candidate"; then
      echo "$candidate"
      return
    fi
  fi
  for candidate in "python$wanted" python3 python; do
    if is_wanted "$candidate"; then
      command -v "$candidate"
      return
    fi
  done
  if command -v uv >/dev/null; then
    say "no Python $wanted here; asking uv to fetch one"
    uv python install --quiet "$wanted" >&2 || return 1
    uv python find --no-project --system "$wanted"
    return
  fi
  return 1
}

# Debian splits ensurepip off, so that a Python may be unable to make a venv with pip.
make_venv() {
  "$1" -m venv --clear .venv >/dev/null 2>&1 && return
  command -v uv >/dev/null && uv venv --quiet --clear --seed --python "$1" .venv && return
  fail "$1 cannot make a virtual environment; on Debian: apt-get install python$wanted-venv"
}

if [[ -x .venv/bin/python ]] && cmp -s "$lock" "$stamp"; then
  exit 0
fi

python=$(find_python) ||
  fail "Python $wanted is needed. Install it with uv ('uv python install $wanted')," \
    "pyenv ('pyenv install $wanted') or your system's packages, and call again."
say "making .venv with $python"
make_venv "$python"
say "installing the packages of $lock (about 600 MB when nothing is cached)"
.venv/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --require-hashes \
  --only-binary :all: --requirement "$lock"
.venv/bin/python .ci/system_libraries.py
cp "$lock" "$stamp"
say "ready"
