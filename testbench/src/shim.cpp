// The part of the shim that is the same for every model. Before it, the generated text defines
// the names used here: V (the model), ROOT_EVAL, SIGNALS, KEY, and the functions on its ports.

// Each of these is noexcept: the frames of their caller are not C++.
#define API extern "C" __attribute__((visibility("default")))

namespace {

constexpr uint64_t STOPPED = 1ull << 63;

// $finish, $stop, failed assertions and fatal errors reach us without a pointer to their model.
// They are left here, counted, and taken by the model that ran on this thread.
std::atomic<uint32_t> events{0};
struct Event {
    bool raised;
    char text[512];
};
thread_local Event event;
thread_local char printed[512];

void raise(const char* what, const char* file, int line) {
    event.raised = true;
    if (event.text[0]) return;  // the first is the cause
    const char* said = printed;
    while (*said == ' ' || *said == '\n') ++said;
    char place[256] = "";
    if (file) std::snprintf(place, sizeof place, " at %s:%d", file, line);
    std::snprintf(event.text, sizeof event.text, "%s%s%s%s", what, place, *said ? ": " : "", said);
    for (size_t n = std::strlen(event.text); n && event.text[n - 1] == '\n'; --n) {
        event.text[n - 1] = 0;
    }
    printed[0] = 0;
    events.fetch_add(1, std::memory_order_relaxed);
}

struct Fatal {};

// Two words that fit the registers of a result.
struct Pair {
    uint64_t seen;
    uint64_t wrong;
};

// Where a stream is in its table. `row` is what is offered or expected next; at `end` there is
// nothing to be read. Without a table `stride` is 0: `row` is then fixed, or means nothing.
struct Cursor {
    const uint64_t* row;
    const uint64_t* end;
    uint64_t stride;
    uint64_t done;
    uint64_t stalled;
    uint64_t first;
    uint64_t last;

    void advance(uint64_t cycle) {
        if (!done) first = cycle;
        ++done;
        last = cycle;
        row += stride;
    }
};

}  // namespace

// Verilator's hooks. None may end the process; a fatal error must not return either, since
// the loop that found no fixed point would go on for ever.
void vl_finish(const char* file, int line, const char*) { raise("$finish", file, line); }
void vl_stop(const char* file, int line, const char*) { raise("$stop or failed assertion", file, line); }
void vl_fatal(const char* file, int line, const char*, const char* message) {
    if (message) wheatstone_print("%s", message);
    raise("fatal error", file, line);
    throw Fatal{};
}

// Takes what is thrown, in a handler.
void caught() {
    try {
        throw;
    } catch (const Fatal&) {
    } catch (const std::exception& error) {
        char what[256];
        std::snprintf(what, sizeof what, "the model throws an exception: %s", error.what());
        raise(what, nullptr, 0);
    } catch (...) {
        raise("the model throws an exception", nullptr, 0);
    }
}

// A model that ends the process by $c or DPI would look like a run that came to its end, and one that doubles it
// would tell everything twice. The linker puts these in the place of the functions of that name.
[[noreturn]] static void refuse_exit(const char* name, int status) {
    // Past what a module prints, which is kept from the terminal.
    dprintf(2, "\nerror: the model calls %s(%d)\n", name, status);
    std::abort();
}
[[noreturn]] static void refuse_fork(const char* name) {
    dprintf(2, "\nerror: the model calls %s(): two processes would go on with the run\n", name);
    std::abort();
}
extern "C" [[noreturn]] void __wrap_exit(int status) { refuse_exit("exit", status); }
extern "C" [[noreturn]] void __wrap__exit(int status) { refuse_exit("_exit", status); }
extern "C" [[noreturn]] void __wrap__Exit(int status) { refuse_exit("_Exit", status); }
extern "C" [[noreturn]] void __wrap_quick_exit(int status) { refuse_exit("quick_exit", status); }
extern "C" [[noreturn]] int __wrap_fork() { refuse_fork("fork"); }
extern "C" [[noreturn]] int __wrap_vfork() { refuse_fork("vfork"); }

// What the model prints is kept: it explains the $stop that follows.
extern "C" int wheatstone_print(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int length = std::vsnprintf(printed, sizeof printed, format, arguments);
    va_end(arguments);
    return length;
}

extern "C" FILE* wheatstone_nowhere() {
    static FILE* const nowhere = std::fopen("/dev/null", "w");
    return nowhere;
}

namespace {

#if VM_TRACE
using Trace = VerilatedFstC;
#else
// A model that is built to be run once writes no waveforms.
struct Trace {
    void dump(uint64_t) {}
    void flush() {}
    void close() {}
    bool isOpen() const { return false; }
};
#endif

struct Handle {
    VerilatedContext context;
    std::unique_ptr<V> top;
    V___024root* root = nullptr;
    std::unique_ptr<Trace> trace;
    void* signals[SIGNALS] = {};
    uint32_t events = 0;
    bool stopped = false;
    bool dead = false;
    char text[sizeof event.text] = "";

    explicit Handle(int seed) {
        // Random values show what is used before it is set. Where coverage is counted, they would count as
        // stimulus: a bit that is only ever read before anything is stored would seem to change.
        context.randReset(VM_COVERAGE ? 0 : 2);
        context.randSeed(seed);
        context.traceEverOn(true);
        context.fatalOnError(false);
    }

    // Takes what happened on this thread, if anything did.
    void collect() {
        if (VL_LIKELY(events == ::events.load(std::memory_order_relaxed))) return;
        events = ::events.load(std::memory_order_relaxed);
        if (!event.raised) return;
        stopped = true;
        std::memcpy(text, event.text, sizeof text);
        event.raised = false;
        event.text[0] = 0;
    }

    // Runs something that may evaluate the model.
    template <typename F>
    void guarded(F f) {
        if (dead) return;
        try {
            f();
        } catch (...) {
            caught();
            dead = true;
        }
        collect();
    }
};

// A signal inside the model, made public by the control file.
void* find(Handle& h, const char* scope, const char* name, int bits) {
    const VerilatedScope* const found = h.context.scopeFind(scope);
    if (!found) throw std::runtime_error(std::string{"no instance "} + scope);
    const VerilatedVar* const var = found->varFind(name);
    if (!var) throw std::runtime_error(std::string{"no signal "} + name + " in " + scope);
    const int width = var->dims() == 0 ? 1 : var->packed().elements();
    if (width != bits) {
        throw std::runtime_error(std::string{"signal "} + name + " in " + scope + " has " + std::to_string(width)
                                 + " bits, not " + std::to_string(bits));
    }
    return var->datap();
}

void bind(Handle& h);
void poke(V___024root* root, uint32_t which, const Cursor* cursors);
void scramble(V___024root* root, uint32_t which, const uint64_t* words);
void drive(V___024root* root, uint32_t bits);
uint64_t sense(const V___024root* root);
uint64_t compare(const V___024root* root, uint64_t seen, const Cursor* cursors);
uint64_t advance(uint64_t taken, uint64_t waiting, uint64_t cycle, Cursor* cursors);
Pair probe(const Handle& h, uint64_t cycle, uint64_t watched, Cursor* cursors);

// The end of a clock: compares what the outputs offer with the rows expected and moves the
// cursors of the streams that were taken and right. The upper half of `seen` tells which of
// them came to the end of their tables.
inline Pair judge(Handle* h, uint64_t cycle, uint64_t drives, Cursor* cursors) {
    h->collect();
    if (VL_UNLIKELY(h->stopped)) return {0, STOPPED};
    const uint64_t seen = sense(h->root);
    const uint64_t wrong = compare(h->root, seen, cursors);
    const uint64_t waiting = (INPUTS & drives & ~seen) | (OUTPUTS & seen & ~drives);
    const uint64_t ended = advance(drives & seen & ~wrong, waiting, cycle, cursors);
    return {seen | ended << 32, wrong};
}

}  // namespace

API const char* wheatstone_key() noexcept { return KEY; }

// Must not run at the same time as another one: Verilator's seeds are global.
API Handle* wheatstone_new(int seed, char* error, size_t size) noexcept {
    std::unique_ptr<Handle> h{new Handle{seed}};
    Verilated::threadContextp(&h->context);
    try {
        h->top.reset(new V{&h->context, "TOP"});
        h->root = h->top->rootp;
        bind(*h);
        h->root->clk_i = 0;
        h->root->rst_i = 1;
        h->top->eval();
        h->collect();
        if (h->stopped) std::snprintf(error, size, "%s", h->text);
    } catch (const std::exception& e) {
        std::snprintf(error, size, "%s", *e.what() ? e.what() : "the model throws an exception");
    } catch (...) {
        caught();
        h->collect();
        std::snprintf(error, size, "%s", h->text);
    }
    // No thread keeps a pointer to this context, which may be deleted by another one.
    Verilated::threadContextp(Verilated::defaultContextp());
    return error[0] ? nullptr : h.release();
}

API void wheatstone_delete(Handle* h) noexcept {
    if (h->trace) h->trace->close();
    h->guarded([=] { h->top->final(); });
    delete h;
}

API void* wheatstone_signal(Handle* h, uint32_t index) noexcept { return index < SIGNALS ? h->signals[index] : nullptr; }

API void wheatstone_eval(Handle* h) noexcept {
    h->guarded([=] { h->top->eval(); });
}

// Applies the inputs of a cycle. The lower half of `pokes` are inputs that offer their row, the
// upper half those that offer nothing and get random words.
inline void apply(V___024root* root, uint32_t drives, uint64_t pokes, const Cursor* cursors, const uint64_t* words) {
    poke(root, pokes, cursors);
    if (pokes >> 32) scramble(root, pokes >> 32, words);
    drive(root, drives);
}

// One clock: finishes the cycle before with the rising edge, applies the inputs of this cycle
// and lets everything settle.
API Pair wheatstone_cycle(Handle* h, uint64_t cycle, uint32_t drives, uint64_t pokes, Cursor* cursors,
                          const uint64_t* words) noexcept {
    V___024root* const root = h->root;
    if (VL_UNLIKELY(h->dead)) return {0, STOPPED};
    try {
        root->clk_i = 1;
        ROOT_EVAL(root);
        apply(root, drives, pokes, cursors, words);
        root->clk_i = 0;
        ROOT_EVAL(root);
    } catch (...) {
        caught();
        h->dead = true;
    }
    return judge(h, cycle, drives, cursors);
}

// The same with a trace: inputs change with the clock's rising edge, at the falling edge
// everything is settled, as in a textbook. The additional evaluation has no edge.
API Pair wheatstone_cycle_traced(Handle* h, uint64_t cycle, uint32_t drives, uint64_t pokes, Cursor* cursors,
                                 const uint64_t* words) noexcept {
    V___024root* const root = h->root;
    h->guarded([=] {
        root->clk_i = 1;
        h->top->eval();
        apply(root, drives, pokes, cursors, words);
        h->top->eval();
        if (h->trace) h->trace->dump(10 * cycle);
        root->clk_i = 0;
        h->top->eval();
        if (h->trace) h->trace->dump(10 * cycle + 5);
    });
    return judge(h, cycle, drives, cursors);
}

// Compares the beats taken inside the module and moves their cursors.
API Pair wheatstone_probe(const Handle* h, uint64_t cycle, uint64_t watched, Cursor* cursors) noexcept {
    return probe(*h, cycle, watched, cursors);
}

// What the model counts of its own code, if it was built so.
API void wheatstone_coverage_clear(Handle* h) noexcept {
#if VM_COVERAGE
    h->context.coveragep()->zero();
#endif
}

API void wheatstone_coverage_write(Handle* h, const char* path) noexcept {
#if VM_COVERAGE
    h->guarded([=] { h->context.coveragep()->write(path); });
#endif
}

API const char* wheatstone_stopped(const Handle* h) noexcept { return h->stopped ? h->text : nullptr; }

API bool wheatstone_trace_open(Handle* h, const char* path) noexcept {
#if VM_TRACE
    h->guarded([=] {
        h->trace.reset(new VerilatedFstC);
        h->top->trace(h->trace.get(), 99);
        h->trace->set_time_unit("1ns");
        h->trace->set_time_resolution("1ns");
        h->trace->open(path);
    });
#endif
    return h->trace && h->trace->isOpen();
}

API void wheatstone_trace_flush(Handle* h) noexcept {
    if (h->trace) h->trace->flush();
}

API void wheatstone_trace_close(Handle* h) noexcept {
    if (h->trace) h->trace->close();
    h->trace.reset();
}
