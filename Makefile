# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later

PYTHON := .venv/bin/python

# Each process that renders takes one to two GB of memory.
PARALLEL := -n auto --maxprocesses 4

.DEFAULT_GOAL := help
.PHONY: help setup demo extension test test-slow lint schema lock clean

help:  ## Show the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-10s %s\n", $$1, $$2 }' Makefile

setup:  ## Make .venv from the lock and check Blender's libraries (each target does it when needed)
	@bash .ci/setup.sh

demo: setup  ## Render the two-hologram AR device and its eyebox to out/demo
	$(PYTHON) -m hoe_addon demo --out out/demo

extension: setup  ## Build the extension for Blender as dist/hoe_addon-VERSION.zip and validate it
	$(PYTHON) .ci/extension.py

test: setup  ## Run the tests that are quick
	$(PYTHON) -m pytest -m "not slow" $(PARALLEL) --dist worksteal

test-slow: setup  ## Run the slow tests: renders, statistics, benchmarks
	@# pytest's exit code 5 says that no test is slow, which is no failure
	$(PYTHON) -m pytest -m slow $(PARALLEL) --dist loadfile || [ $$? -eq 5 ]

lint: setup  ## Check style, format and types
	$(PYTHON) -m ruff check .
	$(PYTHON) -m ruff format --check .
	$(PYTHON) -m pyright

schema:  ## Write the shipped JSON Schemas anew, after a change of the documents
	$(PYTHON) -c "from hoe_addon.model.schema import write_shipped; write_shipped()"

lock:  ## Renew .ci/requirements.lock from pyproject.toml (needs uv)
	uv pip compile pyproject.toml --group dev --universal --python-version 3.13 --generate-hashes \
		--no-emit-index-url --upgrade --quiet --custom-compile-command "make lock" \
		--output-file .ci/requirements.lock

clean:  ## Remove .venv, results and caches
	rm -rf .venv out dist wheels .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
