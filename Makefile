# The main entry. Each target installs missing packages, builds, runs, and ends with one line that names the result.
SHELL  := /bin/bash
PRESET ?= release
BUILD  := $(if $(filter release,$(PRESET)),build,build-$(PRESET))
JOBS   ?= $(shell nproc)

# when make began: the last line of each target says how long it took
export VOUSSOIR_STARTED := $(shell date +%s)

.PHONY: help history build program test test-long coverage reports problems benchmark judge-kernel others deb dist dist-check run format clean

help:
	@echo "make run                 the program alone, and the tutorial's slope: a factor of safety and an interactive page"
	@echo "                         (SCENE=file for another scene, OUT=folder SET='key=value …')"
	@echo "make test                verify: build and run every test (PRESET=dev|asan|tsan for other builds)"
	@echo "make test-long           the long tests"
	@echo "make history             test, and store the values as those of this version: verification/history"
	@echo "make coverage            line coverage of the core's rooms by the unit tests (build-coverage)"
	@echo "make reports             figures, studies and the manual: $(BUILD)/reports/manual-VERSION/index.html, also in one file and as PDF"
	@echo "make problems            problems for any code, from the verdicts of make test: $(BUILD)/problems (BLIND=1: without references)"
	@echo "make benchmark           time the kernels and their peers, and twenty thousand falling blocks, an hour on two cores"
	@echo "                         (VOUSSOIR_FALL_BLOCKS=2000: minutes; VOUSSOIR_BENCHMARK=quick: the contact kernel, a minute)"
	@echo "make judge-kernel KERNEL=./mine.so  judge a contact kernel of your own by exact pairs, and time it (benchmarks/judge)"
	@echo "make others              the problem files in seven other engines beside the program: a table, 20 minutes of two cores"
	@echo "make deb                 Debian packages: build-packages/*.deb"
	@echo "make dist                source archive: build-dist/voussoir-VERSION.tar.gz (dist-check: builds it without network, minutes)"

# $(call configure,options): keeps the options of an existing build
configure = cmake --preset $(PRESET) $(1) > configure.log 2>&1 || { cat configure.log; rm -f configure.log; exit 1; }; \
  mv configure.log $(BUILD)/configure.log; echo "configured preset $(PRESET) in $(BUILD) (log: $(BUILD)/configure.log)"
ALL_ON    := -DVOUSSOIR_BUILD_TESTS=ON -DVOUSSOIR_BUILD_BENCHMARKS=ON -DVOUSSOIR_WITH_PYTHON=ON

# the program alone; a build with tests keeps them
program:
	@cmake/install_packages.sh program
	@$(call configure,$(if $(wildcard $(BUILD)/CMakeCache.txt),,$(subst =ON,=OFF,$(ALL_ON))))
	@cmake --build $(BUILD) --parallel $(JOBS) --target voussoir

# what tests need to run is installed while the compiler works
build:
	@cmake/install_packages.sh program python tests benchmarks
	@$(call configure,$(ALL_ON))
	@cmake/install_packages.sh running & installing=$$!; \
	  cmake --build $(BUILD) --parallel $(JOBS); status=$$?; wait $$installing && exit $$status

test: build
	@cmake/run_tests.sh $(BUILD) $(JOBS)

history: test
	@cmake --build $(BUILD) --target history

test-long: build
	@cmake/install_packages.sh notebooks referees
	@cmake/run_tests.sh $(BUILD) $(JOBS) long

coverage:
	@cmake/install_packages.sh program python tests benchmarks coverage
	@cmake/coverage.sh $(CURDIR) $(CURDIR)/build-coverage $(JOBS)

reports: build
	@cmake --build $(BUILD) --parallel $(JOBS) --target benchmarks
	@cmake/make_reports.sh $(BUILD) $(JOBS)

# from the rows that the cases' tests wrote: make test comes first
problems: build
	@$(BUILD)/verification/voussoir_problems $(BUILD)/problems $(if $(BLIND),--blind)

benchmark:
	@cmake/install_packages.sh program benchmarks
	@$(call configure,-DVOUSSOIR_BUILD_BENCHMARKS=ON $(if $(wildcard $(BUILD)/CMakeCache.txt),,-DVOUSSOIR_BUILD_TESTS=OFF))
	@cmake --build $(BUILD) --parallel $(JOBS) --target benchmarks
	@cmake/run_benchmarks.sh $(BUILD)

judge-kernel:
	@[ -n "$(KERNEL)" ] || { echo "make judge-kernel: KERNEL=./mine.so is missing (benchmarks/judge/README.md)"; exit 2; }
	@cmake/install_packages.sh program tests benchmarks
	@$(call configure,-DVOUSSOIR_BUILD_BENCHMARKS=ON -DVOUSSOIR_BUILD_TESTS=ON)
	@cmake --build $(BUILD) --parallel $(JOBS) --target voussoir_pairs voussoir_judge_kernel
	@$(BUILD)/benchmarks/judge/voussoir_pairs $(BUILD)/reports/pairs
	@$(BUILD)/benchmarks/voussoir_judge_kernel $(BUILD)/reports/pairs/pairs.json "$(KERNEL)" $(BUILD)/reports/kernel

others: build
	@cmake/install_packages.sh others
	@verification/others/compare.sh $(BUILD) $(JOBS)

deb:
	@cmake/install_packages.sh program python packaging
	@cmake/make_packages.sh $(CURDIR)/build-packages $(JOBS)

dist:
	@cmake/make_dist.sh $(CURDIR)/build-dist

dist-check:
	@cmake/install_packages.sh program
	@cmake/check_dist.sh $(CURDIR)/build-dist $(JOBS)

run: program
	@cmake/run_scene.sh $(BUILD) "$(SCENE)" "$(OUT)" $(SET)

format:
	@git ls-files '*.cpp' '*.hpp' | xargs clang-format -i

clean:
	@rm -rf build build-*
