# The commands of the README. Each installs what is missing, configures, builds and runs.
BUILD := build
JOBS := $(shell nproc)
RESULTS := results/slope_cut

.PHONY: help demo test validate build bench figures deps format clean

help:
	@echo "make demo     cut a slope of structured clay and draw what happens, in $(RESULTS)"
	@echo "make test     build and run all tests"
	@echo "make validate  run the verification problems on more meshes and draw them (minutes)"
	@echo "make bench    measure the kernels, in $(BUILD)/bench.json"
	@echo "make build    build the program, $(BUILD)/bin/scarp"
	@echo "make figures  draw the pictures of docs and examples/lab again (minutes)"
	@echo "make format   put the C++ text into the project's format"
	@echo "make clean    remove $(BUILD)"

demo: build
	$(BUILD)/bin/scarp run examples/slope_cut/slope_cut.toml --out $(RESULTS)
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

build: deps
	cmake --preset release -DSCARP_TESTS=OFF -DSCARP_BENCH=OFF
	cmake --build --preset release --parallel $(JOBS)

bench:
	@tools/install-deps.sh --bench
	cmake --preset release -DSCARP_TESTS=OFF -DSCARP_BENCH=ON
	cmake --build --preset release --parallel $(JOBS) --target scarp_bench
	OMP_NUM_THREADS=1 $(BUILD)/bin/scarp_bench --benchmark_repetitions=9 --benchmark_min_time=0.1 \
	  --benchmark_enable_random_interleaving=true --benchmark_out=$(BUILD)/bench.json > $(BUILD)/bench.log
	bench/table.py $(BUILD)/bench.json

figures: build
	for script in examples constants models work_precision kinks; do \
	  /usr/bin/python3 tools/figures/$$script.py $(BUILD)/bin/scarp || exit 1; done

deps:
	@tools/install-deps.sh

format:
	find src apps tests bench -name '*.?pp' | xargs clang-format-14 -i

clean:
	rm -rf $(BUILD)
