# The commands of the README. Each installs what is missing, configures, builds and runs.
BUILD := build
JOBS := $(shell nproc)
RESULTS := results/slope_cut

.PHONY: help demo test validate faults fuzz robustness build bench bench-kernels bench-scaling bench-programs package figures deps format clean

help:
	@echo "make demo     cut a slope of structured clay and draw what happens, in $(RESULTS)"
	@echo "make test     build and run all tests"
	@echo "make validate  run the verification problems on more meshes and draw them (minutes)"
	@echo "make faults   stop runs at random moments and fill their disks, and compare with undisturbed ones (minutes)"
	@echo "make fuzz     feed spoilt files to every reader, TIME=600 seconds each"
	@echo "make robustness  run slopes and columns at many settings: what results depend on (45 minutes)"
	@echo "make bench    measure whole steps, in $(BUILD)/bench.json; make bench-kernels their parts"
	@echo "make build    build the program, $(BUILD)/bin/scarp"
	@echo "make package  one program for every x86-64: build-package/*.deb and *.tar.gz"
	@echo "make figures  draw the pictures of docs and examples/lab again (minutes)"
	@echo "make format   put the C++ text into the project's format"
	@echo "make clean    remove $(BUILD)"

demo: build
	$(BUILD)/bin/scarp run examples/slope_cut/slope_cut.toml --out $(RESULTS) --overwrite
	$(BUILD)/bin/scarp plot $(RESULTS)

test: deps
	cmake --preset release -DSCARP_TESTS=ON -DSCARP_BENCH=OFF
	cmake --build --preset release --parallel $(JOBS)
	ctest --preset release --parallel $(JOBS)

validate: deps
	cmake --preset release -DSCARP_TESTS=ON -DSCARP_BENCH=OFF
	cmake --build --preset release --parallel $(JOBS) --target validate
	mkdir -p $(BUILD)/validate
	$(BUILD)/tests/validate $(BUILD)/validate
	/usr/bin/python3 tools/figures/validate.py $(BUILD)/validate
	/usr/bin/python3 tools/figures/length.py $(BUILD)/validate

# KILLS=300 FILLS=40 SEED=1
faults: deps
	cmake --preset release -DSCARP_TESTS=ON -DSCARP_BENCH=OFF
	cmake --build --preset release --parallel $(JOBS) --target scarp scarp_test_umats
	/usr/bin/python3 tests/faults/faults.py $(BUILD)/bin/scarp --umat $(BUILD)/tests/umat/kinematic_f.so --json $(BUILD)/faults.json \
	  --kills $(or $(KILLS),300) --fills $(or $(FILLS),40) --seed $(or $(SEED),1)
	/usr/bin/python3 tests/faults/long_run.py $(BUILD)/bin/scarp --json $(BUILD)/long_run.json

# TIME=600 seconds for each reader; READERS="case lab gmsh stl csv checkpoint"
fuzz:
	@tools/install-deps.sh --fuzz
	cmake -S . -B build-fuzz -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_BUILD_TYPE=Release -DSCARP_FUZZ=ON
	cmake --build build-fuzz --parallel $(JOBS) --target fuzz
	/usr/bin/python3 tests/fuzz/fuzz.py build-fuzz --time $(or $(TIME),600) --jobs $(JOBS) $(READERS)

# STUDIES="steps plain ...": only those; tools/robustness.py --help
robustness: build
	/usr/bin/python3 tools/robustness.py $(BUILD)/bin/scarp $(if $(STUDIES),--only $(STUDIES))
	/usr/bin/python3 tools/figures/robustness.py

build: deps
	cmake --preset release -DSCARP_TESTS=OFF -DSCARP_BENCH=OFF
	cmake --build --preset release --parallel $(JOBS)

# YARDSTICK=folder of step.cpp and law.cpp; CASES="q4-elastic ..."; POINTS="96000 1000000"; THREADS="1 2"; REPETITIONS=7
bench: bench-programs
	/usr/bin/python3 bench/steps.py --programs $(BUILD)/bench --out $(BUILD)/bench.json $(if $(YARDSTICK),--yardstick "$(YARDSTICK)") \
	  $(if $(CASES),--cases $(CASES)) $(if $(POINTS),--points $(POINTS)) $(if $(THREADS),--threads $(THREADS)) \
	  $(if $(REPETITIONS),--repetitions $(REPETITIONS))

bench-kernels: bench-programs
	OMP_NUM_THREADS=1 $(BUILD)/bin/scarp_bench --benchmark_repetitions=9 --benchmark_min_time=0.1 \
	  --benchmark_enable_random_interleaving=true --benchmark_out=$(BUILD)/kernels.json > $(BUILD)/kernels.log
	bench/table.py $(BUILD)/kernels.json

bench-scaling: bench-programs
	/usr/bin/python3 bench/scaling.py --programs $(BUILD)/bench $(if $(POINTS),--points $(POINTS))

bench-programs:
	@tools/install-deps.sh --bench
	cmake --preset release -DSCARP_TESTS=OFF -DSCARP_BENCH=ON
	cmake --build --preset release --parallel $(JOBS) --target scarp_bench step_bench machine operations

# One program for every x86-64, in build-package/*.deb and *.tar.gz: libscarp is there for each level of the processor.
package: deps
	for arch in x86-64 x86-64-v3 x86-64-v4; do \
	  cmake -S . -B build-package/$$arch -DCMAKE_BUILD_TYPE=Release -DSCARP_ARCH=$$arch -DSCARP_SHARED=ON -DSCARP_TESTS=OFF && \
	  cmake --build build-package/$$arch --parallel $(JOBS) --target scarp || exit 1; done
	rm -f build-package/scarp*.deb build-package/scarp-*.tar.gz
	cpack --config build-package/x86-64/CPackConfig.cmake -B build-package
	/usr/bin/python3 tools/check_package.py build-package/scarp-*.tar.gz

figures: build
	for script in examples constants models work_precision kinks; do \
	  /usr/bin/python3 tools/figures/$$script.py $(BUILD)/bin/scarp || exit 1; done

deps:
	@tools/install-deps.sh

format:
	find src apps tests bench -name '*.?pp' | xargs clang-format-14 -i

clean:
	rm -rf $(BUILD)
