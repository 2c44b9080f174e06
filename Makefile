# make help lists the targets. Override on the command line: make BUILD=san CC=clang
NAME    = kitsuke
VERSION = 0.1.0
BUILD  ?= release
PREFIX ?= /usr/local
CC     ?= cc
# A C compiler asks for its own C++ compiler: the sanitizers of two do not mix. Only its name tells, not its folder's.
ifneq ($(filter default undefined,$(origin CXX)),)
PLUS    = $(foreach w,$(CC),$(patsubst %$(notdir $w),%,$w)$(subst clang,clang++,$(notdir $w)))
CXX     = $(if $(findstring clang,$(notdir $(CC))),$(PLUS),c++)
endif

# A number of things that an enum names is a number: clang 19 and later would have each cast.
WARN   = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wundef -Wwrite-strings -Wno-enum-float-conversion
CWARN  = $(WARN) -Wstrict-prototypes -Wmissing-prototypes -Wvla
SAN    = -g -DVALIDATE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
FLAGS_release = -O3
FLAGS_debug   = -O0 -g -DVALIDATE
FLAGS_san     = -O1 $(SAN)
FLAGS_fuzz    = -O1 $(SAN) -fsanitize=fuzzer-no-link
MODE   = $(FLAGS_$(BUILD))
ifeq ($(MODE),)
$(error BUILD must be release, debug or san, not '$(BUILD)')
endif
# Same bytes from every build and compiler: no contraction to FMA, no fast-math, no -march.
ALL_CFLAGS   = -std=c11 -D_POSIX_C_SOURCE=200809L -D_FILE_OFFSET_BITS=64 -ffp-contract=off -fno-math-errno -fno-trapping-math -pthread $(CWARN) $(MODE) $(CFLAGS)
ALL_CXXFLAGS = -std=c++17 -ffp-contract=off -Wall -Wextra $(MODE) $(CXXFLAGS)
ALL_CPPFLAGS = -iquote include -DKITSUKE_VERSION='"$(VERSION)"' $(CPPFLAGS)
LIBS   = -ldraco -lm -pthread

OUT    = build/$(BUILD)
SRC    = $(wildcard src/*/*.c src/*/*.cpp)
OBJ    = $(SRC:src/%=$(OUT)/%.o)
CORE   = $(filter-out $(OUT)/app/main.c.o,$(OBJ))
UNIT   = $(patsubst tests/%.c,$(OUT)/%.t,$(wildcard tests/unit_*.c))
BENCH  = $(patsubst tests/bench/%.c,$(OUT)/bench/%.o,$(wildcard tests/bench/*.c))
SCRIPT = $(filter-out tests/lib.sh tests/faults.sh tests/cluster.sh,$(wildcard tests/*.sh))
FUZZ   = $(patsubst tests/fuzz/%.c,$(OUT)/%,$(wildcard tests/fuzz/fuzz_*.c))
LINT   = $(patsubst src/%,build/lint/%.ok,$(filter %.c,$(SRC)))
WALK   = motions/paper-walk.bvh
SHOW   = $(WALK) --garment garments/skirt.garment

# A word for each command; make V=1 shows them whole.
Q      = $(if $(V),,@)
SAY    = @$(if $(V)$(findstring s,$(firstword -$(MAKEFLAGS))),:,echo)

all: build/$(NAME)				## build the program (BUILD=release|debug|san)

build/$(NAME): $(OUT)/$(NAME) FORCE
	@cmp -s $< $@ || { cp $< $@.new && mv $@.new $@; }
$(OUT)/$(NAME): $(OBJ) | build/deps
	$(SAY) '  LINK $@'
	$(Q)$(CXX) $(MODE) $(LDFLAGS) $(OBJ) $(LIBS) -o $@
$(OUT)/%.c.o: src/%.c $(OUT)/flags
	@mkdir -p $(@D)
	$(SAY) '  CC   $<'
	$(Q)$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) -MMD -MP -c $< -o $@
$(OUT)/%.cpp.o: src/%.cpp $(OUT)/flags | build/deps
	@mkdir -p $(@D)
	$(SAY) '  C++  $<'
	$(Q)$(CXX) $(ALL_CPPFLAGS) $(ALL_CXXFLAGS) -MMD -MP -c $< -o $@
$(OUT)/core.a: $(CORE) $(OUT)/sources
	@rm -f $@
	$(SAY) '  AR   $@'
	$(Q)ar rcs $@ $(CORE)
$(OUT)/%.t.o: tests/%.c $(OUT)/flags
	$(SAY) '  CC   $<'
	$(Q)$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) -MMD -MP -c $< -o $@
$(OUT)/%.t: $(OUT)/%.t.o $(OUT)/core.a | build/deps
	$(Q)$(CXX) $(MODE) $(LDFLAGS) $^ $(LIBS) -o $@

# Two texts that are only touched when they change, so that other flags, another version or
# another list of sources build what they must. -Werror changes no object.
$(OUT)/flags: TEXT = $(filter-out -Werror,$(CC) $(CXX) $(ALL_CPPFLAGS) $(ALL_CFLAGS) $(ALL_CXXFLAGS))
$(OUT)/sources: TEXT = $(SRC)
$(OUT)/flags $(OUT)/sources: FORCE
	@mkdir -p $(@D)
	@echo '$(subst ','\'',$(TEXT))' | cmp -s - $@ || echo '$(subst ','\'',$(TEXT))' > $@

# What is needed beyond a C compiler is looked for once. Where the user said no more than
# `make demo` or `make test` it may be installed; DEPS=no forbids that.
DEPS ?= $(if $(filter demo test check bench fuzz,$(MAKECMDGOALS)),yes,no)
build/deps:
	@mkdir -p $(@D)
	@DEPS='$(DEPS)' CXX='$(CXX)' FLAGS='$(CPPFLAGS) $(LDFLAGS)' sh .ci/deps.sh draco
	@touch $@
build/deps-test: | build/deps
	@DEPS='$(DEPS)' sh .ci/deps.sh prove
	@touch $@

demo: all					## dress the walk of the paper in a skirt, into build/demo
	build/$(NAME) dress $(SHOW) --output build/demo --force
	@echo 'Look at build/demo/paper-walk: skirt.*.obj and body.*.obj open in any 3D viewer, stats.csv in any spreadsheet.'

figures: all					## draw the figures of the paper, into build/figures
	@mkdir -p build/figures
	@for n in 5 6; do echo "  DRAW build/figures/figure$$n.svg"; \
	build/$(NAME) draw --job tests/golden/figure$$n.job -o build/figures/figure$$n.svg || exit 1; done
	@echo '  DRAW build/figures/figure7a.svg, figure7b.svg'
	@build/$(NAME) compare $(WALK) -g garments/paper-skirt.garment -o build/figures/compare --force --quiet >/dev/null
	@cp build/figures/compare/tests.svg build/figures/figure7a.svg
	@cp build/figures/compare/times.svg build/figures/figure7b.svg

STRIDE = build/$(NAME) walk
motions: all					## make the shipped motions again, in motions/
	$(STRIDE) --preset paper -o motions/paper-walk.bvh
	$(STRIDE) --preset brisk --steps 6 -o motions/brisk-walk.bvh
	$(STRIDE) --stairs 0.17:0.29:5 -o motions/stairs-up.bvh
	$(STRIDE) --stairs -0.17:0.29:5 -o motions/stairs-down.bvh
	$(STRIDE) --slope 12 --steps 6 -o motions/slope.bvh
	$(STRIDE) --preset squat -o motions/squat.bvh
	$(STRIDE) --preset turn --steps 8 -o motions/turn.bvh

JOBS ?= $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
# The bench is built too, so that it keeps up with what it measures.
test: $(OUT)/$(NAME) $(UNIT) $(OUT)/bench/bench build/deps-test	## unit programs and shell tests, through prove
	@KITSUKE='$(CURDIR)/$(OUT)/$(NAME)' KITSUKE_BUILD=$(BUILD) ASAN_OPTIONS=exitcode=99 \
	UBSAN_OPTIONS=exitcode=99:print_stacktrace=1 prove -j$(JOBS) -e '' $(sort $(UNIT) $(SCRIPT))

test-faults: $(OUT)/$(NAME) build/deps-test	## kill, fill the disk, take files away, and resume (FAULTS=20: fewer)
	@KITSUKE='$(CURDIR)/$(OUT)/$(NAME)' KITSUKE_BUILD=$(BUILD) prove -v -e '' tests/faults.sh
test-cluster: $(OUT)/$(NAME) build/deps-test	## shards under Slurm and GNU parallel, as root on one machine
	@DEPS='$(DEPS)' sh .ci/deps.sh slurmctld slurmd sbatch munged parallel || echo 'without them it is skipped'
	@KITSUKE='$(CURDIR)/$(OUT)/$(NAME)' KITSUKE_BUILD=$(BUILD) prove -v -e '' tests/cluster.sh

check:						## test all three builds, and compare the bytes they write
	for b in release debug san; do $(MAKE) BUILD=$$b test || exit 1; rm -rf build/check/$$b; \
	build/$$b/$(NAME) dress $(SHOW) --frames 1:6 --no-times --quiet --output build/check/$$b || exit 1; done
	diff -r build/check/release build/check/debug
	diff -r build/check/release build/check/san
	@echo 'release, debug and san write the same bytes'

# BASE=FILE.csv compares with an earlier result.
bench: all $(OUT)/bench/bench		## time against others' ways, into build/bench.csv (BASE=earlier.csv: compare)
	KITSUKE='$(CURDIR)/build/$(NAME)' $(OUT)/bench/bench build/bench.csv $(BASE)
$(OUT)/bench/%.o: tests/bench/%.c $(OUT)/flags
	@mkdir -p $(@D)
	$(SAY) '  CC   $<'
	$(Q)$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) -DBENCH_FLAGS='"$(strip $(ALL_CFLAGS))"' -MMD -MP -c $< -o $@
$(OUT)/bench/bench: $(BENCH) $(OUT)/core.a
	$(Q)$(CXX) $(MODE) $(LDFLAGS) $^ $(LIBS) -o $@

lint: $(LINT)					## compiler warnings as errors, gcc -fanalyzer, the rules of the house
	sh .ci/lint.sh
# gcc 12's analyzer loses structs that are returned by value and calls them uninitialized, and what
# is stored in an item of an array it calls leaked; leaks are found by the sanitizer build.
ANALYZE = $(if $(findstring clang,$(CC)),,-fanalyzer -Wno-analyzer-use-of-uninitialized-value \
  -Wno-analyzer-malloc-leak)
build/lint/%.c.ok: src/%.c Makefile
	@mkdir -p $(@D)
	$(SAY) '  LINT $<'
	$(Q)$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) -O1 -Werror $(ANALYZE) -MMD -MP -MT $@ -MF $@.d -c $< -o /dev/null
	@touch $@

# The replay feeds every sample whole, cut at every byte and with bytes changed. FUZZ_SECONDS
# with CC=clang goes on searching with libFuzzer, as long for each target.
fuzz:						## feed damaged files to every reader (CC=clang FUZZ_SECONDS=60: search for more)
	$(MAKE) BUILD=$(if $(FUZZ_SECONDS),fuzz,san) fuzz-run
fuzz-run: $(FUZZ)
	@for f in $(FUZZ); do t=$${f##*/fuzz_}; echo "$$t:"; $(if $(FUZZ_SECONDS),mkdir -p build/corpus/$$t; \
	$$f -max_total_time=$(FUZZ_SECONDS) build/corpus/$$t tests/fuzz/seeds/$$t,$$f tests/fuzz/seeds/$$t/*) || exit 1; done
$(OUT)/fuzz_%: tests/fuzz/fuzz_%.c $(if $(FUZZ_SECONDS),,tests/fuzz/replay.c) $(OUT)/core.a | build/deps
	$(Q)$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) $(if $(FUZZ_SECONDS),-fsanitize=fuzzer -fsanitize-link-c++-runtime) $(LDFLAGS) $^ $(LIBS) -lstdc++ -o $@

format:						## clang-format over the .c files (headers are set by hand)
	clang-format -i src/*/*.c src/*/*.cpp tests/*.c tests/fuzz/*.c

# Quoted, as names may have blanks: uninstall must not take half a name for a folder.
PROGRAM = '$(DESTDIR)$(PREFIX)/bin/$(NAME)'
SHARE   = '$(DESTDIR)$(PREFIX)/share/$(NAME)'
install: $(OUT)/$(NAME)				## program, garments and motions, under $(DESTDIR)$(PREFIX)
	install -d '$(DESTDIR)$(PREFIX)/bin' $(SHARE)/garments $(SHARE)/motions
	install -m 755 $(OUT)/$(NAME) $(PROGRAM)
	install -m 644 $(wildcard garments/*) $(SHARE)/garments
	install -m 644 $(wildcard motions/*) $(SHARE)/motions
	install -m 644 $(wildcard LICENSE README.md) $(SHARE)
uninstall:					## undo install
	rm -f $(PROGRAM)
	rm -rf $(SHARE)
dist:						## the committed tree as build/kitsuke-VERSION.tar.gz
	@mkdir -p build
	git archive --prefix=$(NAME)-$(VERSION)/ -o build/$(NAME)-$(VERSION).tar.gz HEAD
clean:						## remove build/
	rm -rf build
help:						## this list
	@awk -F ':.*## *' '/^[a-z-]+:.*## / {printf "  %-12s %s\n", $$1, $$2}' Makefile

-include $(OBJ:.o=.d) $(UNIT:=.d) $(BENCH:.o=.d) $(LINT:=.d)
.PHONY: all demo figures motions test test-faults test-cluster check bench lint fuzz fuzz-run format install uninstall dist clean help FORCE
.SECONDARY:
