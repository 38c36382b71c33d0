/* Expressions against evaluators of their own: random texts from trees whose value the test computes, and
 * functions against long double. */
#include "base/elementary.h"
#include "expr_names.h"

/* ---- Random trees, their value, and their text with as few parentheses as the grammar asks for ---- */

struct made {
    char *text;
    int level;  /* 0 choice, 1 or, 2 and, 3 equal, 4 order, 5 sum, 6 product, 7 unary, 8 power, 9 postfix */
    bool wrong; /* it has no value */
    struct quantity q; /* else this one */
};

static struct arena texts;

/* In parentheses where an operand of that level must be, and sometimes elsewhere. */
static const char *fit(struct random *r, struct made m, int level) {
    return m.level < level || random_below(r, 10) == 0 ? arena_format(&texts, "(%s)", m.text) : m.text;
}

static struct made made_number(const char *text, int level, double value) {
    return (struct made){(char *)text, level, !isfinite(value), {1, {value}}};
}

static struct made make_leaf(struct random *r) {
    static const char *const numbers[] = {"0", "1", "2", "3", "0.5", "10", "7.25", "1e3", ".125", "1e300"};
    const unsigned which = random_below(r, 14);
    if (which < COUNT(numbers)) return made_number(numbers[which], 9, strtod(numbers[which], NULL));
    const struct known *k = &known[random_below(r, 5)];
    return (struct made){(char *)k->name, 9, false, k->value};
}

static struct made make_tree(struct random *r, int depth);

/* The rest of a / b with the sign of b, by its definition where that is exact. */
static double modulo(double a, double b) {
    if (b == 0) return NAN;
    const double rest = fmod(a, b), moved = rest + b;
    return rest == 0 ? 0 : (rest > 0) == (b > 0) ? rest : moved == b ? 0 : moved;
}

static double power(double x, double y) {
    if (x == 0 && y < 0) return NAN;
    if (y == 2) return x * x;
    return y == 0.5 ? sqrt(x) : elementary_pow(x, y);
}

static double apply(char symbol, double a, double b) {
    switch (symbol) {
    case '+': return a + b;
    case '-': return a - b;
    case '*': return a * b;
    case '/': return b == 0 ? NAN : a / b;
    case '%': return modulo(a, b);
    default: return power(a, b);
    }
}

/* The operator between a and b, whose levels are its own and the next. */
static struct made make_arithmetic(struct random *r, int depth) {
    static const char symbols[] = "+-*/%^";
    static const int levels[] = {5, 5, 6, 6, 6, 8};
    const unsigned which = random_below(r, 6);
    const struct made a = make_tree(r, depth - 1), b = make_tree(r, depth - 1);
    const int level = levels[which], left = symbols[which] == '^' ? 9 : level,
              right = symbols[which] == '^' ? 7 : level + 1;
    const char *x = fit(r, a, left), *space = random_below(r, 2) ? " " : "", *y = fit(r, b, right);
    struct made m = {arena_format(&texts, "%s%s%c%s%s", x, space, symbols[which], space, y),
                     level,
                     a.wrong || b.wrong,
                     {0, {0}}};
    if (m.wrong) return m;
    m.wrong = a.q.count != b.q.count && a.q.count != 1 && b.q.count != 1;
    m.q.count = a.q.count > b.q.count ? a.q.count : b.q.count;
    for (unsigned i = 0; i < m.q.count && !m.wrong; i++) {
        m.q.v[i] = apply(symbols[which], a.q.v[a.q.count == 1 ? 0 : i], b.q.v[b.q.count == 1 ? 0 : i]);
        m.wrong = !isfinite(m.q.v[i]);
    }
    return m;
}

static struct made make_comparison(struct random *r, int depth) {
    static const char *const symbols[] = {"<", "<=", ">", ">=", "==", "!="};
    const unsigned which = random_below(r, 6);
    const int level = which < 4 ? 4 : 3;
    const struct made a = make_tree(r, depth - 1), b = make_tree(r, depth - 1);
    const double x = a.q.v[0], y = b.q.v[0];
    const bool holds[] = {x<y, x <= y, x> y, x >= y, x == y, x != y};
    const char *left = fit(r, a, level + 1), *right = fit(r, b, level + 1);
    struct made m =
        made_number(arena_format(&texts, "%s %s %s", left, symbols[which], right), level, holds[which]);
    m.wrong = a.wrong || b.wrong || a.q.count != 1 || b.q.count != 1;
    return m;
}

static struct made make_logic(struct random *r, int depth) {
    const bool or = random_below(r, 2);
    const struct made a = make_tree(r, depth - 1), b = make_tree(r, depth - 1);
    const int level = or ? 1 : 2;
    const char *left = fit(r, a, level), *right = fit(r, b, level + 1);
    const bool enough = or ? a.q.v[0] != 0 : a.q.v[0] == 0;
    struct made m = made_number(arena_format(&texts, "%s%s%s", left, or ? "||" : "&&", right), level,
                                enough ? or : b.q.v[0] != 0);
    m.wrong = a.wrong || a.q.count != 1 || (!enough && (b.wrong || b.q.count != 1));
    return m;
}

static struct made make_choice(struct random *r, int depth) {
    const struct made c = make_tree(r, depth - 1), a = make_tree(r, depth - 1), b = make_tree(r, depth - 1);
    const char *x = fit(r, c, 1), *y = fit(r, a, 0), *z = fit(r, b, 0);
    struct made m = c.q.v[0] != 0 ? a : b;
    m.wrong |= c.wrong || c.q.count != 1;
    m.text = arena_format(&texts, "%s ? %s : %s", x, y, z);
    m.level = 0;
    return m;
}

static struct made make_unary(struct random *r, int depth) {
    struct made m = make_tree(r, depth - 1);
    const bool not = random_below(r, 3) == 0;
    m.text = arena_format(&texts, "%s%s", not ? "!" : "-", fit(r, m, 7));
    m.level = 7;
    m.wrong |= not &&m.q.count != 1;
    for (unsigned i = 0; i < m.q.count; i++) m.q.v[i] = not ? m.q.v[i] == 0 : -m.q.v[i];
    return m;
}

static struct made make_vector(struct random *r, int depth) {
    const unsigned count = 2 + random_below(r, 3);
    struct made m = {"[", 9, false, {count, {0}}};
    for (unsigned i = 0; i < count; i++) {
        const struct made part = make_tree(r, depth - 2);
        m.wrong |= part.wrong || part.q.count != 1;
        m.q.v[i] = part.q.v[0];
        m.text = arena_format(&texts, "%s%s%s", m.text, part.text, i + 1 < count ? ", " : "]");
    }
    return m;
}

static struct made make_part(struct random *r, int depth) {
    static const char *const parts[] = {".x", ".y", ".z", ".r", ".g", ".b", "[0]", "[1]", "[2]", "[4 - 1]"};
    static const unsigned indices[] = {0, 1, 2, 0, 1, 2, 0, 1, 2, 3};
    const struct made whole = make_tree(r, depth - 1);
    const unsigned which = random_below(r, COUNT(parts));
    /* The point after a number is its own. */
    const char *text = whole.text[0] >= '0' && whole.text[0] <= '9' ? arena_format(&texts, "(%s)", whole.text)
                                                                    : fit(r, whole, 9);
    struct made m =
        made_number(arena_format(&texts, "%s%s", text, parts[which]), 9, whole.q.v[indices[which]]);
    m.wrong = whole.wrong || whole.q.count == 1 || indices[which] >= whole.q.count;
    return m;
}

static double least(double a, double b) { return a < b ? a : b; }
static double greatest(double a, double b) { return a > b ? a : b; }

static struct made make_call(struct random *r, int depth) {
    static const struct {
        const char *name;
        double (*one)(double), (*two)(double, double);
    } functions[] = {{"abs", fabs, NULL},  {"floor", floor, NULL}, {"ceil", ceil, NULL},
                     {"sqrt", sqrt, NULL}, {"trunc", trunc, NULL}, {"round", round, NULL},
                     {"min", NULL, least}, {"max", NULL, greatest}};
    const unsigned which = random_below(r, COUNT(functions));
    const struct made a = make_tree(r, depth - 1),
                      b = functions[which].two ? make_tree(r, depth - 1) : made_number("", 9, 0);
    struct made m = {arena_format(&texts, "%s(%s%s%s)", functions[which].name, a.text,
                                  functions[which].two ? ", " : "", b.text),
                     9,
                     a.wrong || b.wrong,
                     {0, {0}}};
    m.wrong |= a.q.count != b.q.count && a.q.count != 1 && b.q.count != 1;
    m.q.count = a.q.count > b.q.count ? a.q.count : b.q.count;
    for (unsigned i = 0; i < m.q.count && !m.wrong; i++) {
        const double x = a.q.v[a.q.count == 1 ? 0 : i], y = b.q.v[b.q.count == 1 ? 0 : i];
        m.q.v[i] = functions[which].one ? functions[which].one(x) : functions[which].two(x, y);
        m.wrong = !isfinite(m.q.v[i]);
    }
    return m;
}

static struct made make_tree(struct random *r, int depth) {
    static struct made (*const makers[])(struct random *, int) = {
        make_arithmetic, make_arithmetic, make_arithmetic, make_comparison, make_logic,
        make_choice,     make_unary,      make_vector,     make_part,       make_call,
    };
    return depth <= 0 || random_below(r, 5) == 0 ? make_leaf(r)
                                                 : makers[random_below(r, COUNT(makers))](r, depth);
}

static void random_trees_have_their_value(void **state) {
    (void)state;
    struct random r = random_begin();
    unsigned right = 0, wrong = 0;
    for (int i = 0; i < 60000; i++) {
        const struct made m = make_tree(&r, 1 + (int)random_below(&r, 6));
        const size_t size = strlen(m.text);
        struct expr_error error = {0};
        struct quantity got = {0};
        unsigned asked = 0;
        if (size > 4000) continue;
        const enum expr_result result = parse_and_evaluate(&texts, m.text, size, &asked, &got, &error);
        if ((result == EXPR_OK) == m.wrong)
            fail_msg("%s: %s", m.text, m.wrong ? "should be wrong" : error.message);
        if (m.wrong && strcmp(error.code, "bad-expression") == 0) fail_msg("%s: %s", m.text, error.message);
        if (!m.wrong) assert_int_equal(got.count, m.q.count);
        for (unsigned k = 0; k < got.count; k++)
            if (got.v[k] != m.q.v[k])
                fail_msg("%s: part %u: got %.17g, want %.17g", m.text, k, got.v[k], m.q.v[k]);
        *(m.wrong ? &wrong : &right) += size > 10;
        arena_free(&texts);
    }
    assert_true(right > 8000 && wrong > 2000); /* else it is no test */
}

/* ---- Functions ---- */

static double call(const char *text) {
    struct expr_error error = {0};
    struct quantity got = {0};
    unsigned asked = 0;
    if (parse_and_evaluate(&texts, text, strlen(text), &asked, &got, &error) != EXPR_OK)
        fail_msg("%s: %s", text, error.message);
    arena_free(&texts);
    return got.v[0];
}

static double call_at(const char *name, unsigned count, const double *x) {
    char text[200];
    int size = sprintf(text, "%s(", name);
    for (unsigned i = 0; i < count; i++) size += sprintf(text + size, "%s%.17g", i ? ", " : "", x[i]);
    sprintf(text + size, ")");
    return call(text);
}

static const long double degree = 3.14159265358979323846264338327950288L / 180;

static long double sin_long(const double *x) { return sinl(fmodl(x[0], 360) * degree); }
static long double cos_long(const double *x) { return cosl(fmodl(x[0], 360) * degree); }
static long double tan_long(const double *x) { return tanl(fmodl(x[0], 180) * degree); }
static long double asin_long(const double *x) { return asinl(x[0]) / degree; }
static long double acos_long(const double *x) { return acosl(x[0]) / degree; }
static long double atan_long(const double *x) { return atanl(x[0]) / degree; }
static long double atan2_long(const double *x) { return atan2l(x[0], x[1]) / degree; }
static long double exp_long(const double *x) { return expl(x[0]); }
static long double log_long(const double *x) { return logl(x[0]); }
static long double log2_long(const double *x) { return log2l(x[0]); }
static long double log10_long(const double *x) { return log10l(x[0]); }
static long double pow_long(const double *x) { return powl(x[0], x[1]); }
static long double sqrt_long(const double *x) { return sqrtl(x[0]); }
static long double mod_long(const double *x) { return x[0] - x[1] * floorl((long double)x[0] / x[1]); }
static long double mix_long(const double *x) {
    return x[0] * (1 - (long double)x[2]) + (long double)x[1] * x[2];
}
static long double step_long(const double *x) { return x[1] >= x[0]; }
static long double smoothstep_long(const double *x) {
    const long double t = fminl(fmaxl(((long double)x[2] - x[0]) / ((long double)x[1] - x[0]), 0), 1);
    return t * t * (3 - 2 * t);
}
static long double sign_long(const double *x) { return (x[0] > 0) - (x[0] < 0); }

static struct oracle {
    const char *name;
    unsigned count;
    double low, high;
    long double (*want)(const double *x);
    double tolerance; /* relative to the result, or to 1 when that is less */
} oracles[] = {
    {"sin", 1, -1000, 1000, sin_long, 1e-15},
    {"cos", 1, -1000, 1000, cos_long, 1e-15},
    {"tan", 1, -89, 89, tan_long, 2e-15},
    {"asin", 1, -1, 1, asin_long, 1e-15},
    {"acos", 1, -1, 1, acos_long, 1e-15},
    {"atan", 1, -100, 100, atan_long, 1e-15},
    {"atan2", 2, -10, 10, atan2_long, 1e-15},
    {"exp", 1, -100, 100, exp_long, 1e-15},
    {"log", 1, 1e-6, 1e3, log_long, 1e-15},
    {"log2", 1, 1e-6, 1e3, log2_long, 1e-15},
    {"log10", 1, 1e-6, 1e3, log10_long, 1e-15},
    {"pow", 2, 0, 20, pow_long, 1e-15},
    {"sqrt", 1, 0, 1e6, sqrt_long, 1e-15},
    {"mod", 2, -20, 20, mod_long, 1e-14},
    {"mix", 3, -20, 20, mix_long, 1e-13},
    {"step", 2, -2, 2, step_long, 0},
    {"smoothstep", 3, -20, 20, smoothstep_long, 1e-12},
    {"sign", 1, -2, 2, sign_long, 0},
};

static void check_oracle(void **state) {
    const struct oracle *o = *state;
    struct random r = random_begin();
    for (int i = 0; i < 3000; i++) {
        const double x[3] = {random_between(&r, o->low, o->high), random_between(&r, o->low, o->high),
                             random_between(&r, o->low, o->high)};
        const double got = call_at(o->name, o->count, x), want = (double)o->want(x);
        assert_near(got, want, o->tolerance * (fabs(want) > 1 ? fabs(want) : 1), o->name);
    }
}

static void angles_of_sines_lead_back(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 1000; i++) {
        char text[300];
        const double x = (double)random_below(&r, 100000) / 8;
        sprintf(text,
                "sin(%.17g) == sin(%.17g + 360) && cos(%.17g) == cos(%.17g - 720) && sin(%.17g) == cos(%.17g "
                "- 90)",
                x, x, x, x, x, x);
        if (call(text) != 1) fail_msg("%s", text);
        sprintf(text, "sin(%.17g) ^ 2 + cos(%.17g) ^ 2", x, x);
        assert_near(call(text), 1, 4e-16, text);
    }
}

/* ---- Colours ---- */

static void a_hue_is_what_the_web_says(void **state) {
    (void)state;
    /* CSS names of known hues, in the words of its hsl() turned to hsv. */
    static const struct {
        const char *color, *same;
    } rows[] = {{"hsv(39 - 9 / 255, 0, 1)", "white"},
                {"hsv(0, 1, 128 / 255)", "maroon"},
                {"hsv(300, 1, 1)", "magenta"},
                {"hsv(180, 1, 1)", "cyan"},
                {"hsv(60, 1, 128 / 255)", "olive"},
                {"hsv(720 + 240, 1, 128 / 255)", "navy"},
                {"rgb(255, 99, 71)", "tomato"},
                {"rgb(70, 130, 180)", "steelblue"},
                {"hsv(60 * 28 / 184, 184 / 255, 1)", "tomato"}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        char text[200];
        sprintf(text, "distance(%s, %s)", rows[i].color, rows[i].same);
        assert_near(call(text), 0, 1e-15, text);
    }
}

/* ---- Random numbers and noise ---- */

static void random_numbers_are_even(void **state) {
    (void)state;
    enum { BOXES = 20, EACH = 500 };
    unsigned boxes[BOXES] = {0}, pairs[BOXES] = {0};
    double last = 0;
    for (int i = 0; i < BOXES * EACH; i++) {
        const double x = call_at("random", 2, (const double[]){i % 100, floor(i / 100)});
        assert_true(x >= 0 && x < 1);
        boxes[(int)(x * BOXES)]++;
        pairs[(int)((x - last + (x < last)) * BOXES)]++;
        last = x;
    }
    double chi = 0, chi_pairs = 0;
    for (int i = 0; i < BOXES; i++) {
        chi += (boxes[i] - (double)EACH) * (boxes[i] - (double)EACH) / EACH;
        chi_pairs += (pairs[i] - (double)EACH) * (pairs[i] - (double)EACH) / EACH;
    }
    if (chi > 45 || chi_pairs > 45)
        fail_msg("chi squares %g and %g, of 19 degrees of freedom", chi,
                 chi_pairs); /* one in 1000 has 43.8 */
}

static void random_is_the_same_everywhere(void **state) {
    (void)state;
    assert_true(call("random(1, 2, 3)") == 0.5115926941369916);
    assert_true(call("noise(0.5, 1.25, 3.75)") == 0.0054682228465699661);
}

static void noise_is_smooth_and_fills_its_range(void **state) {
    (void)state;
    struct random r = random_begin();
    for (unsigned dimensions = 1; dimensions <= 3; dimensions++) {
        double least_seen = 0, most_seen = 0, squares = 0;
        enum { TIMES = 8000 };
        for (int i = 0; i < TIMES; i++) {
            double at[3];
            for (unsigned k = 0; k < 3; k++) at[k] = random_between(&r, -50, 50);
            if (i % 2)
                at[random_below(&r, dimensions)] =
                    floor(at[0]); /* on a face of cells, where slips would show */
            const double here = call_at("noise", dimensions, at);
            assert_true(fabs(here) <= 1);
            least_seen = fmin(least_seen, here);
            most_seen = fmax(most_seen, here);
            squares += here * here;
            for (int way = -1; way <= 1; way += 2) {
                double next[3] = {at[0] + way * 1e-6, at[1], at[2]};
                assert_near(call_at("noise", dimensions, next), here, 6e-6, "noise nearby");
            }
            for (unsigned k = 0; k < 3; k++) at[k] = floor(at[k]);
            assert_true(call_at("noise", dimensions, at) == 0);
        }
        if (least_seen > -0.6 || most_seen < 0.6 || squares / TIMES < 0.04)
            fail_msg("%u: %g to %g, variance %g", dimensions, least_seen, most_seen, squares / TIMES);
    }
}

/* At whole places the noise is its slope there times the way. */
static void slopes_of_noise_point_everywhere(void **state) {
    (void)state;
    static const double mean_square[] = {0, 4.0 / 3, 1, 4.0 / 9};
    enum { TIMES = 3000 };
    for (unsigned dimensions = 1; dimensions <= 3; dimensions++)
        for (unsigned axis = 0; axis < dimensions; axis++) {
            double sum = 0, squares = 0;
            for (int i = 0; i < TIMES; i++) {
                double at[] = {i % 13 - 6, i / 13 % 17 - 8, floor(i / 221)};
                if (dimensions == 1) at[0] = i;
                if (dimensions == 2) at[1] = floor(i / 13);
                at[axis] += 1e-3;
                const double slope = call_at("noise", dimensions, at) * 1e3;
                sum += slope;
                squares += slope * slope;
            }
            const double deviation = sqrt(mean_square[dimensions] / TIMES);
            assert_near(sum / TIMES, 0, 4 * deviation, "mean slope");
            assert_near(squares / TIMES, mean_square[dimensions], 0.08 * mean_square[dimensions],
                        "mean square of slopes");
        }
}

static void noise_goes_far_out(void **state) {
    (void)state;
    assert_true(call("noise(1e300)") == 0);
    assert_true(call("noise(-1e17, 0.5, 1e30)") <= 1);
}

int main(void) {
    struct CMUnitTest tests[COUNT(oracles)];
    for (size_t i = 0; i < COUNT(oracles); i++)
        tests[i] = (struct CMUnitTest){oracles[i].name, check_oracle, NULL, NULL, &oracles[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(random_trees_have_their_value),
        cmocka_unit_test(angles_of_sines_lead_back),
        cmocka_unit_test(a_hue_is_what_the_web_says),
        cmocka_unit_test(random_numbers_are_even),
        cmocka_unit_test(random_is_the_same_everywhere),
        cmocka_unit_test(noise_is_smooth_and_fills_its_range),
        cmocka_unit_test(slopes_of_noise_point_everywhere),
        cmocka_unit_test(noise_goes_far_out),
    };
    return cmocka_run_group_tests_name("oracles", tests, NULL, NULL) +
           cmocka_run_group_tests_name("random", others, NULL, NULL);
}
