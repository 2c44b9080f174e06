# make help lists the targets. Override on the command line: make BUILD=san CC=clang
NAME    = kitsuke
VERSION = 0.1.0
BUILD  ?= release
PREFIX ?= /usr/local
CC     ?= cc
CXX    ?= c++

WARN   = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wundef -Wwrite-strings
CWARN  = $(WARN) -Wstrict-prototypes -Wmissing-prototypes -Wvla
FLAGS_release = -O3
FLAGS_debug   = -O0 -g -DVALIDATE
FLAGS_san     = -O1 -g -DVALIDATE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
MODE   = $(FLAGS_$(BUILD))
ifeq ($(MODE),)
$(error BUILD must be release, debug or san, not '$(BUILD)')
endif
ALL_CFLAGS   = -std=c11 -D_POSIX_C_SOURCE=200809L -ffp-contract=off -pthread $(CWARN) $(MODE) $(CFLAGS)
ALL_CXXFLAGS = -std=c++17 -ffp-contract=off -Wall -Wextra $(MODE) $(CXXFLAGS)
ALL_CPPFLAGS = -iquote include -DKITSUKE_VERSION='"$(VERSION)"' $(CPPFLAGS)
LIBS   = -ldraco -lstdc++ -lm -pthread

OUT    = build/$(BUILD)
SRC    = $(wildcard src/*/*.c src/*/*.cpp)
OBJ    = $(patsubst src/%,$(OUT)/%.o,$(SRC))
CORE   = $(filter-out $(OUT)/app/main.c.o,$(OBJ))
UNIT   = $(patsubst tests/%.c,$(OUT)/%.t,$(wildcard tests/unit_*.c))

all: build/$(NAME)				## build the program (BUILD=release|debug|san)

build/$(NAME): $(OUT)/$(NAME)
	cp -f $< $@
$(OUT)/$(NAME): $(OBJ)
	$(CC) $(MODE) $(LDFLAGS) $^ $(LIBS) -o $@
$(OUT)/%.c.o: src/%.c
	@mkdir -p $(@D)
	$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) -MMD -MP -c $< -o $@
$(OUT)/%.cpp.o: src/%.cpp
	@mkdir -p $(@D)
	$(CXX) $(ALL_CPPFLAGS) $(ALL_CXXFLAGS) -MMD -MP -c $< -o $@
$(OUT)/core.a: $(CORE)
	@rm -f $@
	ar rcs $@ $^
$(OUT)/%.t: tests/%.c $(OUT)/core.a
	$(CC) $(ALL_CPPFLAGS) $(ALL_CFLAGS) $< $(OUT)/core.a $(LIBS) -o $@

clean:						## remove build/
	rm -rf build

-include $(OBJ:.o=.d)
.PHONY: all clean
