# The front door. Each target installs what is missing, builds, runs, and ends with one line that says where the result is.
SHELL  := /bin/bash
PRESET ?= release
BUILD  := $(if $(filter release,$(PRESET)),build,build-$(PRESET))
JOBS   ?= $(shell nproc)

.PHONY: help history packages configure build test test-long coverage reports benchmark deb run format clean

help:
	@echo "make test                verify: build and run every test (PRESET=dev|asan|tsan for other builds)"
	@echo "make test-long           the long tests"
	@echo "make history             test, and keep the values as those of this version: verification/history"
	@echo "make coverage            line coverage of the core's rooms by the unit tests (build-coverage)"
	@echo "make reports             figures, studies and the verification manual: $(BUILD)/reports/manual-VERSION.html"
	@echo "make benchmark           time the kernels and their peers, and twenty thousand falling blocks, an hour of two cores"
	@echo "                         (VOUSSOIR_FALL_BLOCKS=2000: minutes; VOUSSOIR_BENCHMARK=quick: the contact kernel, a minute)"
	@echo "make deb                 Debian packages, without Ipopt: build-packages/*.deb"
	@echo "make run SCENE=file      run one scene (OUT=folder SET='key=value …')"

packages:
	@cmake/install_packages.sh

configure: packages
	@cmake --preset $(PRESET) > configure.log 2>&1 || { cat configure.log; rm -f configure.log; exit 1; }
	@mv configure.log $(BUILD)/configure.log
	@echo "configured preset $(PRESET) in $(BUILD) (log: $(BUILD)/configure.log)"

build: configure
	@cmake --build $(BUILD) --parallel $(JOBS)

test: build
	@cmake/run_tests.sh $(BUILD) $(JOBS)

history: test
	@cmake --build $(BUILD) --target history

test-long: build
	@cd $(BUILD) && ctest -C Long -L long --output-on-failure --parallel $(JOBS)

coverage: packages
	@command -v gcovr >/dev/null || cmake/install_packages.sh gcovr
	@cmake/coverage.sh $(CURDIR) $(CURDIR)/build-coverage $(JOBS)

reports: build
	@cmake --build $(BUILD) --parallel $(JOBS) --target benchmarks
	@cmake/make_reports.sh $(BUILD) $(JOBS)

benchmark: configure
	@cmake --build $(BUILD) --parallel $(JOBS) --target benchmarks
	@cmake/run_benchmarks.sh $(BUILD)

deb: packages
	@cmake/install_packages.sh dpkg-dev file lintian
	@cmake/make_packages.sh $(CURDIR)/build-packages $(JOBS)

run: build
	@test -n "$(SCENE)" || { echo "make run: name a scene, e.g. make run SCENE=cases/wedge/scene.toml"; exit 2; }
	@$(BUILD)/app/voussoir run $(SCENE) $(if $(OUT),--out $(OUT)) $(foreach s,$(SET),--set $(s))

format:
	@git ls-files '*.cpp' '*.hpp' | xargs clang-format -i

clean:
	@rm -rf build build-*
