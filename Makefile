# Monge's build, for GNU make 4. `make help` lists the targets.
#
# CC, CFLAGS, LDFLAGS, PREFIX, DESTDIR are the user's. What the pictures depend on is kept apart from
# CFLAGS, so that CFLAGS=-O0 (or -O3, or -march=native) gives the same bits. V=1 shows the commands.
#
# A part of the program on its own, wherever you like:
#     make test T=affine STATIONS=base BUILD=/tmp/mine

VERSION := 0.1.0

BUILD := build
PREFIX ?= /usr/local
CFLAGS ?= -O2 -g
JOBS = $(eval JOBS := $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1))$(JOBS)

# The folders of src/ in their order: each uses those before it, never those after.
STATIONS := base lang scene shape accel render image cli
# Where the tests of editors and of reports have their packages; the same for all variants of the build.
export NODE_FOLDER ?= $(abspath $(BUILD))/editor
export BROWSER_FOLDER ?= $(abspath $(BUILD))/browser
LIBRARIES := yaml-0.1 libpng libdeflate sleef

# ---- Flags ----

WARNINGS := -Wall -Wextra -Wshadow -Wconversion -Wmissing-prototypes
LANGUAGE := -std=c17 -ffp-contract=off -fno-math-errno -D_GNU_SOURCE -Isrc -I$(BUILD)/gen
# Asked once, and not before it is needed: a fresh machine has no pkg-config yet.
PKG_CFLAGS = $(eval PKG_CFLAGS := $(shell pkg-config --cflags $(LIBRARIES) cmocka 2>/dev/null))$(PKG_CFLAGS)
PKG_LIBS = $(eval PKG_LIBS := $(shell pkg-config --libs $(LIBRARIES) 2>/dev/null))$(PKG_LIBS)

# VARIANT is what `make check` and its like add.
COMPILE = $(CC) $(CFLAGS) $(VARIANT) $(LANGUAGE) -pthread $(WARNINGS) $(PKG_CFLAGS)
LINK = $(CC) $(CFLAGS) $(VARIANT) -pthread $(LDFLAGS)
LIBS = $(PKG_LIBS) -lpthread -lm

# ---- Files ----

ifneq ($(filter cli,$(STATIONS)),)
PROGRAM := $(BUILD)/monge
FACE := $(wildcard src/*.c)
endif
SOURCES := $(wildcard $(STATIONS:%=src/%/*.c) $(STATIONS:%=src/%/*/*.c)) $(FACE)
UNIT := $(wildcard tests/unit/test_*.c)
ifneq ($(filter lang,$(STATIONS)),)
GRAMMAR := $(BUILD)/gen/grammar_tables $(BUILD)/gen/grammar_schema
STORIES := $(BUILD)/gen/stories
endif

# Which program it is: a hash of all that it is made from.
PROGRAM_SOURCES := $(sort $(wildcard src/*.[ch] src/*/*.[ch] src/*/*/*.[ch] src/cli/golden/page/* tools/embed grammar/*.yaml tools/grammar/*.[ch] tools/diagnostics.c)) scenes/presets.yaml
IDENTITY := $(BUILD)/gen/program

object = $(patsubst %.c,$(BUILD)/obj/%.o,$(1))
OBJECTS := $(call object,$(filter-out src/cli/%,$(SOURCES))) $(patsubst $(BUILD)/%,$(BUILD)/obj/%.o,$(GRAMMAR) $(STORIES) $(IDENTITY))
CLI_OBJECTS := $(call object,$(filter src/cli/%,$(SOURCES))) $(BUILD)/obj/gen/page.o
TOOL_OBJECTS := $(call object,$(wildcard src/base/*.c src/lang/yaml.c src/lang/events.c src/lang/spelling.c))

UNIT_PROGRAMS := $(UNIT:tests/unit/%.c=$(BUILD)/tests/%)
TESTS := $(wildcard tests/*.sh) $(UNIT_PROGRAMS)
ifdef T
UNIT_PROGRAMS := $(filter $(BUILD)/tests/test_$(T:test_%=%),$(UNIT_PROGRAMS))
TESTS := $(UNIT_PROGRAMS) $(filter tests/$(T) tests/$(T).sh,$(TESTS))
PROGRAM_OF_TESTS := $(if $(filter %.sh,$(TESTS)),$(PROGRAM))
else
PROGRAM_OF_TESTS := $(PROGRAM)
endif

QUIET := $(if $(V),,@)
say = @printf '  %-5s %s\n' $(1) $(2)
# In a sub-make, so that the libraries which `deps` has just brought are seen; `+` passes -j on.
SUBMAKE = $(MAKE) --no-print-directory $(if $(findstring -j,$(MAKEFLAGS)),,-j$(JOBS))

# ---- What people ask for ----

.DEFAULT_GOAL := all
.PHONY: node-deps all demo test check tsan same kill fuzz coverage mutants bench reference format lint deps install uninstall clean help

all: ## build the program, build/monge
	@tools/deps --check
	+@$(SUBMAKE) build-program

demo: deps ## render the scenes of scenes/report/, and the chess board, to out/
	+@$(SUBMAKE) build-program
	@mkdir -p out
	$(BUILD)/monge render -o out/ scenes/report/*.yaml
	$(BUILD)/monge render -o out/ --samples 16 scenes/report/final.yaml
	$(BUILD)/monge render -o out/ scenes/gallery/chess.yaml
	@echo "The pictures are in $(CURDIR)/out"

test: deps node-deps ## run all tests; T=name runs tests/unit/test_name.c or tests/name.sh alone, T=name_% all of that name
	+@$(SUBMAKE) run-tests EXTRA_TESTS=$(if $(T),,tools/includes)

SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
check: deps node-deps ## the tests under the address and undefined-behaviour sanitizers, in a hostile build; with clang too
	+@$(SUBMAKE) run-tests BUILD=$(BUILD)/check VARIANT="-O1 $(SANITIZE) -DMONGE_HOSTILE"
	@if tools/deps --sanitizes clang; then echo "With clang:"; else echo "No clang here: gcc alone."; fi
	+@if tools/deps --sanitizes clang; then $(SUBMAKE) run-tests CC=clang BUILD=$(BUILD)/check-clang \
	    VARIANT="-O1 $(SANITIZE) -DMONGE_HOSTILE"; fi

tsan: deps node-deps ## the tests under the thread sanitizer
	+@$(SUBMAKE) run-tests BUILD=$(BUILD)/tsan VARIANT="-O1 -fsanitize=thread"

same: all ## that the golden pictures are the same from other compilers and optimization levels
	+@$(SUBMAKE) build-program BUILD=$(BUILD)/same/gcc-O0 CC=gcc CFLAGS=-O0
	tests/goldens.sh $(BUILD)/same/gcc-O0/monge
	+@$(SUBMAKE) build-program BUILD=$(BUILD)/same/gcc-native CC=gcc CFLAGS="-O3 -march=native"
	tests/goldens.sh $(BUILD)/same/gcc-native/monge
	+@if command -v clang >/dev/null; then $(SUBMAKE) build-program BUILD=$(BUILD)/same/clang CC=clang CFLAGS=-O2 && \
	    tests/goldens.sh $(BUILD)/same/clang/monge; fi

kill: all ## kill batches at 200 random moments, and look at what they leave
	KILLS=200 tests/kill.sh $(BUILD)/monge

fuzz: deps ## a minute of hostile bytes for the loader (libFuzzer where clang has it)
	tests/fuzz/run.sh 60 $(BUILD)/fuzz

# A copy, so that nobody's work is in the way; optimized, as some ways make no difference to what is compiled.
N ?= 200
SEED ?= 1
mutants: deps ## break the geometry, shading and sampling in N=200 small ways, one at a time: what do the tests notice? SEED=1
	@mkdir -p $(BUILD)/mutants && cd $(BUILD)/mutants && rm -rf grammar scenes src tests tools
	@cp -Rp LICENSE Makefile README.md grammar scenes src tests tools $(BUILD)/mutants
	+@$(SUBMAKE) -C $(BUILD)/mutants run-mutants BUILD=build CFLAGS=-O2 VARIANT="-fPIC -fno-semantic-interposition" \
	    N=$(N) SEED=$(SEED)

coverage: deps node-deps ## the tests with gcc's line coverage, per file of src/; fails below 90 %, or at an error that no test makes
	@find $(BUILD)/coverage -name '*.gcda' -delete 2>/dev/null || true
	+@$(SUBMAKE) run-tests CC=gcc CFLAGS="-O0 -g" BUILD=$(BUILD)/coverage VARIANT="--coverage -fprofile-update=atomic"
	@tools/coverage $(BUILD)/coverage 90

bench: all ## measure reading beside libyaml, rendering, and comparing beside odiff
	+@$(SUBMAKE) $(BUILD)/tools/measure $(BUILD)/tools/yaml_events
	@tools/bench $(BUILD)

reference: ## make reference.md, errors.md and scene.schema.json in grammar/ anew from grammar/*.yaml
	+@$(SUBMAKE) $(BUILD)/tools/grammar $(BUILD)/tools/diagnostics
	$(BUILD)/tools/grammar reference grammar grammar/reference.md
	$(BUILD)/tools/grammar schema grammar grammar/scene.schema.json
	$(BUILD)/tools/diagnostics reference grammar/diagnostics.yaml grammar/errors.md

format: ## lay out the code by .clang-format, where clang-format is installed
	@if command -v clang-format >/dev/null; then clang-format -i $(wildcard src/*.[ch] src/*/*.[ch] src/*/*/*.[ch] tests/unit/*.[ch] tools/grammar/*.[ch]); \
	 else echo "format: clang-format is not installed"; fi

lint: ## compile everything with warnings as errors, with clang too
	+@$(SUBMAKE) build-all BUILD=$(BUILD)/lint VARIANT=-Werror
	+@if command -v clang >/dev/null; then $(SUBMAKE) build-all CC=clang BUILD=$(BUILD)/lint-clang VARIANT=-Werror; fi

deps: ## install what the build needs and is not there
	@tools/deps

# Node, Chromium and their packages, for the tests of editors and reports alone; without T=, or for the one that needs them.
node-deps:
	@case '$(T)' in '' | schema) tools/deps --editor $(NODE_FOLDER) ;; esac
	@case '$(T)' in '' | page) tools/deps --browser $(BROWSER_FOLDER) ;; esac

help: ## this list
	@echo "Monge $(VERSION). Targets:"
	@sed -n 's/^\([a-z]*\):[^#]*## /\1\t/p' Makefile | while IFS="$$(printf '\t')" read -r target text; do \
	    printf '  make %-10s %s\n' "$$target" "$$text"; done
	@echo "Variables: CC CFLAGS LDFLAGS PREFIX=$(PREFIX) DESTDIR BUILD=$(BUILD) T V=1"

clean: ## remove build/ and out/
	rm -rf $(BUILD) out

# ---- Installing ----

BIN = $(DESTDIR)$(PREFIX)/bin
LIB = $(DESTDIR)$(PREFIX)/lib
INCLUDE = $(DESTDIR)$(PREFIX)/include
SHARE = $(DESTDIR)$(PREFIX)/share
DOCS = README.md LICENSE grammar/manual.md grammar/testing.md grammar/reference.md grammar/errors.md
BASH_COMPLETION = $(SHARE)/bash-completion/completions/monge
ZSH_COMPLETION = $(SHARE)/zsh/site-functions/_monge
FISH_COMPLETION = $(SHARE)/fish/vendor_completions.d/monge.fish

install: all ## to PREFIX (under DESTDIR): program, library, manual page, completions, schema, documents
	mkdir -p $(BIN) $(LIB)/pkgconfig $(INCLUDE) $(SHARE)/man/man1 $(SHARE)/doc/monge $(SHARE)/monge \
	    $(dir $(BASH_COMPLETION) $(ZSH_COMPLETION) $(FISH_COMPLETION))
	install -m 755 $(BUILD)/monge $(BIN)/monge
	install -m 644 $(BUILD)/libmonge.a $(LIB)/libmonge.a
	install -m 644 src/monge.h $(INCLUDE)/monge.h
	printf '%s\n' 'Name: monge' 'Description: renders scenes that are data' 'Version: $(VERSION)' \
	    'Requires: $(LIBRARIES)' 'Cflags: -I$(PREFIX)/include' 'Libs: -L$(PREFIX)/lib -lmonge -lpthread -lm' \
	    > $(LIB)/pkgconfig/monge.pc
	$(BUILD)/monge help --man > $(SHARE)/man/man1/monge.1
	$(BUILD)/monge help --completion bash > $(BASH_COMPLETION)
	$(BUILD)/monge help --completion zsh > $(ZSH_COMPLETION)
	$(BUILD)/monge help --completion fish > $(FISH_COMPLETION)
	install -m 644 $(DOCS) $(SHARE)/doc/monge
	install -m 644 grammar/scene.schema.json grammar/golden.schema.json $(SHARE)/monge

uninstall: ## remove what install put there
	rm -f $(BIN)/monge $(LIB)/libmonge.a $(LIB)/pkgconfig/monge.pc $(INCLUDE)/monge.h $(SHARE)/man/man1/monge.1 \
	    $(BASH_COMPLETION) $(ZSH_COMPLETION) $(FISH_COMPLETION)
	rm -rf $(SHARE)/doc/monge $(SHARE)/monge

# ---- How it is made ----

.PHONY: build-program build-all run-tests run-mutants FORCE
.SECONDARY:
.DELETE_ON_ERROR:

build-program: $(BUILD)/monge
build-all: $(PROGRAM) $(BUILD)/libmonge.a $(UNIT:tests/unit/%.c=$(BUILD)/tests/%)

run-mutants: build-all $(BUILD)/tools/mutate
	@CC='$(CC)' COMPILE='$(COMPILE)' LINK='$(LINK)' LIBS='$(LIBS)' VERSION=$(VERSION) JOBS=$(JOBS) \
	    WRAPPED='$(patsubst WRAPPED_%,%,$(filter WRAPPED_%,$(.VARIABLES)))' tools/mutants $(BUILD) $(N) $(SEED)

run-tests: $(UNIT_PROGRAMS) $(PROGRAM_OF_TESTS)
	@CC='$(CC)' FLAGS='$(LANGUAGE) $(WARNINGS) $(PKG_CFLAGS)' JOBS=$(JOBS) SHOW='$(T)' \
	    tools/test $(BUILD) $(TESTS) $(EXTRA_TESTS)

$(BUILD)/monge: $(CLI_OBJECTS) $(BUILD)/libmonge.a
	$(call say,link,$@)
	$(QUIET)$(LINK) -o $@ $^ $(LIBS)

$(BUILD)/libmonge.a: $(OBJECTS)
	$(call say,ar,$@)
	$(QUIET)rm -f $@ && ar qcs $@ $^

# What a test has of its own, to see what happens when it fails.
WRAPPED_test_format := layout_same_events
WRAPPED_test_memory := malloc calloc realloc
WRAPPED_test_progress := clock_gettime

$(BUILD)/tests/%: $(BUILD)/obj/tests/unit/%.o $(BUILD)/libmonge.a
	@mkdir -p $(@D)
	$(call say,link,$@)
	$(QUIET)$(LINK) $(WRAPPED_$*:%=-Wl,--wrap=%) -o $@ $^ -lcmocka $(LIBS)

$(BUILD)/tools/grammar: $(call object,$(wildcard tools/grammar/*.c)) $(TOOL_OBJECTS)
	@mkdir -p $(@D)
	$(call say,link,$@)
	$(QUIET)$(LINK) -o $@ $^ $(LIBS)

$(BUILD)/tools/measure $(BUILD)/tools/mutate $(BUILD)/tools/yaml_events: $(BUILD)/tools/%: $(BUILD)/obj/tools/%.o
	@mkdir -p $(@D)
	$(call say,link,$@)
	$(QUIET)$(LINK) -o $@ $^ $(LIBS)

$(BUILD)/tools/diagnostics: $(call object,tools/diagnostics.c src/lang/file.c) $(TOOL_OBJECTS)
	@mkdir -p $(@D)
	$(call say,link,$@)
	$(QUIET)$(LINK) -o $@ $^ $(LIBS)

$(BUILD)/gen/page.c: tools/embed $(wildcard src/cli/golden/page/*)
	@mkdir -p $(@D)
	$(call say,gen,$@)
	$(QUIET)tools/embed src/cli/golden/page > $@

$(BUILD)/gen/program.c: $(PROGRAM_SOURCES)
	@mkdir -p $(@D)
	$(call say,gen,$@)
	$(QUIET){ printf '#include "base/program.h"\nconst char program_hash[] = "'; cat $^ | sha256sum | cut -c 1-32 | tr -d '\n'; \
	    printf '";\n'; } > $@

$(BUILD)/gen/stories.c: $(BUILD)/tools/diagnostics grammar/diagnostics.yaml
	@mkdir -p $(@D)
	$(call say,gen,$@)
	$(QUIET)$< tables grammar/diagnostics.yaml $@

$(BUILD)/gen/grammar_tables.h: $(BUILD)/tools/grammar $(wildcard grammar/*.yaml) scenes/presets.yaml
	@mkdir -p $(@D)
	$(call say,gen,$@)
	$(QUIET)$< tables-header grammar $@

$(BUILD)/gen/grammar_tables.c: $(BUILD)/tools/grammar $(wildcard grammar/*.yaml) scenes/presets.yaml
	@mkdir -p $(@D)
	$(call say,gen,$@)
	$(QUIET)$< tables grammar $@

$(BUILD)/gen/grammar_schema.c: $(BUILD)/tools/grammar $(wildcard grammar/*.yaml)
	@mkdir -p $(@D)
	$(call say,gen,$@)
	$(QUIET)$< schema-source grammar $@

# The header comes before any object may need it; after that the .d files know which do.
$(filter-out $(TOOL_OBJECTS),$(OBJECTS) $(CLI_OBJECTS)) $(call object,$(UNIT)): | $(firstword $(GRAMMAR:%=%.h))

$(BUILD)/obj/%.o: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,cc,$<)
	$(QUIET)$(COMPILE) -DMONGE_VERSION='"$(VERSION)"' -MMD -MP -c -o $@ $<

$(BUILD)/obj/gen/%.o: $(BUILD)/gen/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,cc,$<)
	$(QUIET)$(COMPILE) -MMD -MP -c -o $@ $<

# Changes when the flags do, and with it everything compiled.
$(BUILD)/flags: FORCE
	@mkdir -p $(@D)
	@echo '$(COMPILE) $(LDFLAGS) $(VERSION)' | cmp -s - $@ || echo '$(COMPILE) $(LDFLAGS) $(VERSION)' > $@

-include $(shell find $(BUILD)/obj -name '*.d' 2>/dev/null)
