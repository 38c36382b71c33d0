/* Expressions: what they are worth, what is wrong with them and where, and what is hostile. */
#include "expr_names.h"
#include "lang/grammar.h"

/* ---- Values ---- */

static struct value_row {
    const char *text;
    struct quantity want;
} values[] = {
    {"42", {1, {42}}},
    {" \t42\n", {1, {42}}},
    {".5 + 5. + 1e2 + 1.5E-1", {1, {105.65}}},
    {"1 + 2 * 3", {1, {7}}},
    {"(1 + 2) * 3", {1, {9}}},
    {"7 - 2 - 1", {1, {4}}},
    {"8 / 4 / 2", {1, {1}}},
    {"2 ^ 3 ^ 2", {1, {512}}},
    {"-2 ^ 2", {1, {-4}}},
    {"(-2) ^ 2", {1, {4}}},
    {"2 ^ -1", {1, {0.5}}},
    {"-n", {1, {-3}}},
    {"- - n", {1, {3}}},
    {"+n", {1, {3}}},
    {"2 - -n", {1, {5}}},
    {"!0 + !5", {1, {1}}},
    {"7 % 3", {1, {1}}},
    {"-7 % 3", {1, {2}}},
    {"7 % -3", {1, {-2}}},
    {"-6 % 3", {1, {0}}},
    {"5.5 % 2", {1, {1.5}}},
    {"-1e-20 % 3", {1, {0}}},
    {"1 < 2 && 2 <= 2 && 3 > 2 && 3 >= 3 && 1 != 2 && 2 == 2", {1, {1}}},
    {"2 < 1 || 2 > 3 || 2 <= 1 || 2 >= 3 || 1 == 2 || 2 != 2", {1, {0}}},
    {"5 && -2", {1, {1}}},
    {"0 || 3", {1, {1}}},
    {"1 + 1 < 3", {1, {1}}},
    {"1 < 2 == 2 < 3", {1, {1}}},
    {"1 == 1 && 0 || 1", {1, {1}}},
    {"0 || 1 && 0", {1, {0}}},
    {"n < 5 ? 10 : 20", {1, {10}}},
    {"n > 5 ? 10 : 20", {1, {20}}},
    {"0 ? 1 : 0 ? 2 : 3", {1, {3}}},
    {"1 ? 0 ? 1 : 2 : 3", {1, {2}}},
    {"1 ? v : 0", {3, {1, 2, 3}}},
    {"true + false", {1, {1}}},
    {"tau == 2 * pi", {1, {1}}},
    {"[1, n]", {2, {1, 3}}},
    {"[1, 2, 3, 4]", {4, {1, 2, 3, 4}}},
    {"v + 1", {3, {2, 3, 4}}},
    {"10 - v", {3, {9, 8, 7}}},
    {"v * v", {3, {1, 4, 9}}},
    {"12 / v", {3, {12, 6, 4}}},
    {"v % 2", {3, {1, 0, 1}}},
    {"v ^ 2", {3, {1, 4, 9}}},
    {"-v", {3, {-1, -2, -3}}},
    {"v.x", {1, {1}}},
    {"v.y + v.z", {1, {5}}},
    {"v.r * 100 + v.g * 10 + v.b", {1, {123}}},
    {"v[0] * 100 + v[n - 2] * 10 + v[2]", {1, {123}}},
    {"[5, 6][1]", {1, {6}}},
    {"(v + 1).x", {1, {2}}},
    {"-v.x ^ 2", {1, {-1}}},
    {"max(v, 2).x", {1, {2}}},
    {"red", {3, {1, 0, 0}}},
    {"Red.r", {1, {1}}},
    {"#f00", {3, {1, 0, 0}}},
    {"#FF0000 * 0.5", {3, {0.5, 0, 0}}},
    {"mix(black, white, 0.25)", {3, {0.25, 0.25, 0.25}}},
    {"n * [1, 0, 0] + v", {3, {4, 2, 3}}},
    {"abs([-1, 2, -3])", {3, {1, 2, 3}}},
    {"min(5, [1, 9], 3)", {2, {1, 3}}},
    {"clamp(v, 1.5, 2.5)", {3, {1.5, 2, 2.5}}},
    {"step(2, v)", {3, {0, 1, 1}}},
    {"smoothstep(0, 4, v)", {3, {0.15625, 0.5, 0.84375}}},
    {"mix([0, 10], [10, 20], [0.5, 1])", {2, {5, 20}}},
    {"mix(0.1, 0.7, 1)", {1, {0.7}}},
    {"round(-2.5)", {1, {-3}}},
    {"4 ^ 0.5", {1, {2}}},
    {"0 ^ 0", {1, {1}}},
    {"0 ^ 2", {1, {0}}},
    {"(-8) ^ 3", {1, {-512}}},
    {"(-2) ^ -2", {1, {0.25}}},
    {"10 ^ 15", {1, {1e15}}},
    {"sin(750)", {1, {0.5}}},
    {"sin(180)", {1, {0}}},
    {"cos([0, 60, 90, 120])", {4, {1, 0.5, 0, -0.5}}},
    {"tan([45, 135, 225, -45])", {4, {1, -1, 1, -1}}},
    {"asin([-1, -0.5, 0, 0.5])", {4, {-90, -30, 0, 30}}},
    {"acos([-1, -0.5, 0, 1])", {4, {180, 120, 90, 0}}},
    {"atan([1, -1, 0])", {3, {45, -45, 0}}},
    {"atan2([0, 1, 1, -1], [-1, 0, 1, -1])", {4, {180, 90, 45, -135}}},
    {"atan2(0 * -1, -1)", {1, {180}}},
    {"atan2(0, 0)", {1, {0}}},
    {"length(-3)", {1, {3}}},
    {"length([3, 4] * 2 ^ 1000) == 5 * 2 ^ 1000", {1, {1}}},
    {"length([3, 4] * 2 ^ -1000) == 5 * 2 ^ -1000", {1, {1}}},
    {"length(v - v)", {1, {0}}},
    {"normalize([3, 4] * 2 ^ 1000)", {2, {0.6, 0.8}}},
    {"normalize([-3, 0, 4] * 2 ^ -1070)", {3, {-0.6, 0, 0.8}}},
    {"cross(v, [3, 2, 1])", {3, {-4, 8, -4}}},
    {"dot(v, [1, 10, 100])", {1, {321}}},
    {"random(1, v) == random(1, v)", {1, {1}}},
    {"random(0) == random(-0)", {1, {1}}},
    {"random(1, 2) == random(2, 1)", {1, {0}}},
    {"noise(5) + noise(5, 7) + noise(5, 7, -2)", {1, {0}}},
    {"hsv(0, 1, 1)", {3, {1, 0, 0}}},
    {"hsv(60, 1, 1)", {3, {1, 1, 0}}},
    {"hsv(-120, 1, 1)", {3, {0, 0, 1}}},
    {"hsv(77, 0, 1)", {3, {1, 1, 1}}},
    {"hsv(77, 1, 0)", {3, {0, 0, 0}}},
    {"rgb(0, 255, 0)", {3, {0, 1, 0}}},
    {"1 ? 2 : 1 / 0", {1, {2}}},
    {"0 ? nobody : 2", {1, {2}}},
    {"0 && nobody", {1, {0}}},
    {"1 || 1 / 0", {1, {1}}},
    {"0 && steel", {1, {0}}},
    {"1 ? 1 : later", {1, {1}}},
};

static void check_value(void **state) {
    const struct value_row *row = *state;
    struct arena arena = {0};
    struct expr_error error = {0};
    struct quantity got = {0};
    unsigned asked = 0;
    if (parse_and_evaluate(&arena, row->text, strlen(row->text), &asked, &got, &error) != EXPR_OK)
        fail_msg("%s: %s (%s)", row->text, error.message, error.code);
    assert_int_equal(got.count, row->want.count);
    for (unsigned i = 0; i < got.count; i++)
        if (got.v[i] != row->want.v[i])
            fail_msg("%s: part %u: got %.17g, want %.17g", row->text, i, got.v[i], row->want.v[i]);
    arena_free(&arena);
}

/* ---- Mistakes ---- */

static struct error_row {
    const char *text, *code;
    size_t offset, length;
    const char *message, *help;
} errors[] = {
    {"PI", "unknown-variable", 0, 2, "nothing here is named `PI`", "did you mean `pi`?"},
    {"1/0", "division-by-zero", 1, 1, "division by zero", NULL},
    {"1 / (n - 3)", "division-by-zero", 2, 1, "division by zero: `n - 3` is 0", NULL},
    {"v / [1, 0, 2]", "division-by-zero", 2, 1, "division by zero: `[1, 0, 2]` is [1, 0, 2]", NULL},
    {"sqrt(-1)", "outside-domain", 0, 4, "sqrt of -1", "sqrt takes 0 or more"},
    {"sqrt([1,-4])", "outside-domain", 0, 4, "sqrt of [1, -4]", "sqrt takes 0 or more"},
    {"log(0)", "outside-domain", 0, 3, "log of 0", "log takes more than 0"},
    {"asin(2)", "outside-domain", 0, 4, "asin of 2", "asin takes -1 to 1"},
    {"1e300 * 1e300", "not-finite", 6, 1, "1e+300 * 1e+300 is too large: numbers end at 1.8e308", NULL},
    {"exp(1000)", "not-finite", 0, 3, "exp of 1000 is too large: numbers end at 1.8e308", NULL},
    {"(-8)^(1/3)", "outside-domain", 4, 1, "-8 ^ 0.333333: a negative number has only whole powers", NULL},
    {"0^-1", "division-by-zero", 1, 1, "division by zero: 0 ^ -1", NULL},
    {"7 % 0", "division-by-zero", 2, 1, "division by zero", NULL},
    {"deph + 1", "unknown-variable", 0, 4, "nothing here is named `deph`", "did you mean `depth`?"},
    {"qqqqqq + 1", "unknown-variable", 0, 6, "nothing here is named `qqqqqq`",
     "in scope: depth, later, n, steel, v, w, zero"},
    {"sin + 1", "unknown-variable", 0, 3, "nothing here is named `sin`", "it is a function: write `sin(x)`"},
    {"sine(3)", "unknown-function", 0, 4, "there is no function `sine`", "did you mean `sin(x)`?"},
    {"foo(3)", "unknown-function", 0, 3, "there is no function `foo`", "to multiply, write `foo * (`"},
    {"mix(1, 2)", "wrong-arguments", 0, 3, "`mix` takes 3 arguments, found 2",
     "mix(a, b, t): From a at t = 0 straight to b at t = 1, and on."},
    {"[1,2] + [1,2,3]", "different-counts", 6, 1, "a vector of 2 meets a vector of 3: [1, 2] and [1, 2, 3]",
     NULL},
    {"v && 1", "not-a-number", 0, 1, "expected a number, found a vector of 3: [1, 2, 3]",
     "take a part of it: .x, .y, .z, .r, .g or .b, or its length(v)"},
    {"v < 2", "not-a-number", 0, 1, "expected a number, found a vector of 3: [1, 2, 3]",
     "take a part of it: .x, .y, .z, .r, .g or .b, or its length(v)"},
    {"steel * 2", "not-a-quantity", 0, 5, "`steel` is no number, vector or colour", NULL},
    {"late + 1", "unknown-variable", 0, 4, "nothing here is named `late`", "did you mean `later`?"},
    {"n = 3", "bad-expression", 2, 1, "`=` is no operator", "did you mean `==`?"},
    {"n and 1", "bad-expression", 2, 3, "expected an operator, found `and`", "write `&&`"},
    {"not n", "bad-expression", 4, 1, "expected an operator, found `n`", "write `!`"},
    {"2 ** 3", "bad-expression", 2, 2, "`**` is no operator", "write `^`"},
    {"5 mod 3", "bad-expression", 2, 3, "expected an operator, found `mod`", "write `%`"},
    {"0,5 + 1", "bad-expression", 1, 1, "expected an operator, found `,`",
     "the decimal point is a point: write 0.5"},
    {"(0,5)", "bad-expression", 2, 1, "expected an operator or `)`, found `,`",
     "the decimal point is a point: write 0.5"},
    {"1, 2", "bad-expression", 1, 1, "expected an operator, found `,`", "a vector is written [x, y, z]"},
    {"(1 + 2", "bad-expression", 0, 1, "this `(` is not closed", "add `)`"},
    {"(1 + [2, 3)", "bad-expression", 5, 1, "this `[` is not closed", "add `]` before `)`"},
    {"sin(1 + 2", "bad-expression", 3, 1, "this `(` is not closed", "add `)`"},
    {"2x", "bad-expression", 1, 1, "expected an operator, found `x`", "to multiply, write `2 * x`"},
    {"2(3+4)", "bad-expression", 1, 1, "expected an operator, found `(`", "to multiply, write `2 * (`"},
    {"45deg", "bad-expression", 2, 3, "expected an operator, found `deg`",
     "numbers have no unit here: write 45"},
    {"3 \xe2"
     "\x88"
     "\x92"
     " 4",
     "bad-expression", 2, 3, "a typographic minus (U+2212) is no sign of the language", "write `-`"},
    {"sin 30", "bad-expression", 4, 2, "expected an operator, found `30`", "write `sin(30)`"},
    {"Math.sin(3)", "bad-expression", 0, 8, "functions and constants stand alone: there is no `Math.`",
     "write `sin`"},
    {"math.PI", "bad-expression", 0, 7, "functions and constants stand alone: there is no `math.`",
     "write `pi`"},
    {"1 +", "bad-expression", 3, 0, "expected a value after `+`",
     "leave out the `+`, or write a value after it"},
    {"1 + * 2", "bad-expression", 4, 1, "expected a value after `+`, found `*`", NULL},
    {"1 < 2 < 3", "bad-expression", 6, 1, "expected an operator, found `<`",
     "comparisons do not chain: write `a < b && b < c`"},
    {"1 == 2 == 3", "bad-expression", 7, 2, "expected an operator, found `==`",
     "comparisons do not chain: write `a < b && b < c`"},
    {"0x1F", "bad-expression", 0, 4, "numbers are decimal", "write 31"},
    {"010", "leading-zero", 0, 3, "a number with a leading zero",
     "write 10; some readers take a leading zero for base 8"},
    {"1_000", "bad-expression", 0, 5, "a number has no underscores", "write 1000"},
    {"1e", "bad-expression", 1, 1, "expected an operator, found `e`", "to multiply, write `1 * e`"},
    {"1e999", "too-large", 0, 5, "too large: numbers end at 1.8e308", NULL},
    {"#12", "bad-expression", 0, 3, "a colour in hexadecimal has 3 or 6 digits 0-9 a-f", NULL},
    {"3 )", "bad-expression", 2, 1, "nothing is open that `)` could close", "leave it out"},
    {"1 : 2", "bad-expression", 2, 1, "`:` without `?`", "write `condition ? this : that`"},
    {"n ? 1", "bad-expression", 2, 1, "this `?` has no `:`", "write `condition ? this : that`"},
    {"n ? 1, 2", "bad-expression", 2, 1, "this `?` has no `:`", "write `condition ? this : that`"},
    {"\"red\"", "bad-expression", 0, 1, "a quote has no meaning here",
     "numbers, names and colours stand without quotes"},
    {"$n", "bad-expression", 0, 1, "`$` has no meaning here", "write the name alone"},
    {"v.w", "bad-expression", 2, 1, "there is no part `w`", "parts are .x .y .z, .r .g .b and [i]"},
    {"v[3]", "outside-domain", 1, 3, "a vector of 3 has no part 3", "its parts are 0, 1 and 2"},
    {"v[0.5]", "outside-domain", 1, 5, "the part 0.5 of a vector", "write floor(i) for a whole number"},
    {"n.x", "not-a-vector", 1, 2, "`n` is a number and has no parts", NULL},
    {"[1]", "bad-expression", 0, 3, "a vector has 2 to 4 numbers, found 1", "remove the brackets"},
    {"[[1,2],3]", "not-a-number", 1, 5, "expected a number, found a vector of 2: [1, 2]",
     "take a part of it: [0], or its length(v)"},
    {"50%", "bad-expression", 3, 0, "expected a value after `%`", "there is no percent: 50 % is 0.5"},
    {"max(1,2,)", "bad-expression", 8, 1, "expected a value after `,`, found `)`", "leave out the `,`"},
    {"sin()", "wrong-arguments", 0, 3, "`sin` takes 1 argument, found 0",
     "sin(x): The sine of an angle in degrees."},
    {"clamp(1, 3, 2)", "outside-domain", 0, 5, "clamp of 1, 3 and 2", "clamp takes low up to high"},
    {"normalize([0,0,0])", "outside-domain", 0, 9, "normalize of [0, 0, 0]",
     "normalize takes a vector other than 0"},
    {"cross([1,2],[3,4])", "wrong-arguments", 0, 5, "cross of a vector of 2 and a vector of 2",
     "cross(a, b): The vector product of two vectors of 3."},
    {"dot([1,2],[3,4,5])", "different-counts", 0, 3, "dot of a vector of 2 and a vector of 3",
     "dot(a, b): The scalar product of two vectors."},
    {"tomatoe", "unknown-variable", 0, 7, "nothing here is named `tomatoe`",
     "did you mean the colour `tomato`?"},
    {"a.b.c", "bad-expression", 4, 1, "there is no part `c`", "parts are .x .y .z, .r .g .b and [i]"},
    {"", "bad-expression", 0, 0, "there is no expression", NULL},
    {"   ", "bad-expression", 3, 0, "there is no expression", NULL},
    {"x ! y", "bad-expression", 2, 1, "expected an operator, found `!`", NULL},
    {"(((1)", "bad-expression", 1, 1, "this `(` is not closed", "add `)`"},
    {"f(g(1)", "unknown-function", 0, 1, "there is no function `f`", "to multiply, write `f * (`"},
    {"1 <> 2", "bad-expression", 2, 2, "`<>` is no operator", "write `!=`"},
    {"n // 2", "bad-expression", 2, 2, "`//` is no operator",
     "a quotient without its broken part is floor(a / b)"},
    {"foo", "unknown-variable", 0, 3, "nothing here is named `foo`",
     "in scope: depth, later, n, steel, v, w, zero"},
    {"lerp(1,2,3)", "unknown-function", 0, 4, "there is no function `lerp`", "did you mean `mix(a, b, t)`?"},
    {"and", "unknown-variable", 0, 3, "nothing here is named `and`", "write `&&`"},
    {"((1)))", "bad-expression", 5, 1, "nothing is open that `)` could close", "leave it out"},
    {"90\xc2"
     "\xb0"
     "",
     "bad-expression", 2, 2, "a degree sign has no meaning here",
     "angles are in degrees anyway: leave it out"},
    {"zero && (", "bad-expression", 9, 0, "expected a value after `(`", NULL},
    {"v ? 1 : 2", "not-a-number", 0, 1, "expected a number, found a vector of 3: [1, 2, 3]",
     "take a part of it: .x, .y, .z, .r, .g or .b, or its length(v)"},
    {"!v", "not-a-number", 1, 1, "expected a number, found a vector of 3: [1, 2, 3]",
     "take a part of it: .x, .y, .z, .r, .g or .b, or its length(v)"},
    {"sin(v, 1)", "wrong-arguments", 0, 3, "`sin` takes 1 argument, found 2",
     "sin(x): The sine of an angle in degrees."},
    {"min(3)", "wrong-arguments", 0, 3, "`min` takes at least 2 arguments, found 1",
     "min(a, b, ...): The least."},
    {"random()", "wrong-arguments", 0, 6, "`random` takes at least 1 argument, found 0",
     "random(seed, ...): A number from 0 to just under 1 that looks random, always the same for the same "
     "numbers or vectors."},
    {"random(1,2,3,4,5,6,7,8,9)", "wrong-arguments", 0, 6, "`random` takes at most 8 arguments, found 9",
     "random(seed, ...): A number from 0 to just under 1 that looks random, always the same for the same "
     "numbers or vectors."},
    {"noise(v, 1)", "wrong-arguments", 0, 5, "noise of a vector of 3 and a number",
     "noise(x, y, z): Smooth noise from -1 to 1 at a place: 1 to 3 numbers, or a vector of 2 or 3. It is 0 "
     "where all are whole."},
    {"noise([1,2,3,4])", "wrong-arguments", 0, 5, "noise of a vector of 4",
     "noise(x, y, z): Smooth noise from -1 to 1 at a place: 1 to 3 numbers, or a vector of 2 or 3. It is 0 "
     "where all are whole."},
    {"rgb(256, 0, 0)", "outside-domain", 0, 3, "rgb of 256, 0 and 0", "rgb takes 0 to 255"},
    {"rgb(v, 0, 0)", "wrong-arguments", 0, 3, "rgb of a vector of 3, a number and a number",
     "rgb(r, g, b): The linear colour of sRGB parts from 0 to 255, as on the web."},
    {"hsv(0, 2, 1)", "outside-domain", 0, 3, "hsv of 0, 2 and 1",
     "hsv takes a saturation and a value of 0 to 1"},
    {"smoothstep(1, 1, 0)", "outside-domain", 0, 10, "smoothstep of 1, 1 and 0",
     "smoothstep takes a low other than high"},
    {"mod(3, zero)", "outside-domain", 0, 3, "mod of 3 and 0", "mod takes a b other than 0"},
    {"tan(90)", "outside-domain", 0, 3, "tan of 90", "tan takes angles other than 90, 270 and so on"},
    {"tan(-270)", "outside-domain", 0, 3, "tan of -270", "tan takes angles other than 90, 270 and so on"},
    {"log2(0)", "outside-domain", 0, 4, "log2 of 0", "log2 takes more than 0"},
    {"log10(-1)", "outside-domain", 0, 5, "log10 of -1", "log10 takes more than 0"},
    {"acos(-1.5)", "outside-domain", 0, 4, "acos of -1.5", "acos takes -1 to 1"},
    {"normalize(3)", "wrong-arguments", 0, 9, "normalize of a number",
     "normalize(v): The vector at length 1."},
    {"distance(v, w)", "different-counts", 0, 8, "distance of a vector of 3 and a vector of 2",
     "distance(a, b): The distance of two points."},
    {"mix(v, w, 0.5)", "different-counts", 0, 3, "mix of a vector of 3, a vector of 2 and a number",
     "mix(a, b, t): From a at t = 0 straight to b at t = 1, and on."},
    {"v + w", "different-counts", 2, 1, "a vector of 3 meets a vector of 2: [1, 2, 3] and [10, 20]", NULL},
    {"w / (v.x - 1)", "division-by-zero", 2, 1, "division by zero: `v.x - 1` is 0", NULL},
    {"(v - v)[0] ^ -1", "division-by-zero", 11, 1, "division by zero: 0 ^ -1", NULL},
    {"0 / 0", "division-by-zero", 2, 1, "division by zero", NULL},
    {"1e308 + 1e308", "not-finite", 6, 1, "1e+308 + 1e+308 is too large: numbers end at 1.8e308", NULL},
    {"-1e308 - 1e308", "not-finite", 7, 1, "-1e+308 - 1e+308 is too large: numbers end at 1.8e308", NULL},
    {"1e200 ^ 2", "not-finite", 6, 1, "1e+200 ^ 2 is too large: numbers end at 1.8e308", NULL},
    {"mix(1e308, -1e308, 2)", "not-finite", 0, 3,
     "mix of 1e+308, -1e+308 and 2 is too large: numbers end at 1.8e308", NULL},
    {"n(3)", "unknown-function", 0, 1, "there is no function `n`", "to multiply, write `n * (`"},
    {"n 3", "bad-expression", 2, 1, "expected an operator, found `3`", NULL},
    {"sin n", "bad-expression", 4, 1, "expected an operator, found `n`", "write `sin(n)`"},
    {"sin[3]", "unknown-variable", 0, 3, "nothing here is named `sin`", "it is a function: write `sin(x)`"},
    {"sni(30)", "unknown-function", 0, 3, "there is no function `sni`", "did you mean `sin`?"},
    {"Sin(30)", "unknown-function", 0, 3, "there is no function `Sin`", "did you mean `sin`?"},
    {"tau2", "unknown-variable", 0, 4, "nothing here is named `tau2`", "did you mean `tau`?"},
    {"not(n)", "unknown-function", 0, 3, "there is no function `not`", "write `!`"},
    {"if (n, 1, 2)", "unknown-function", 0, 2, "there is no function `if`",
     "write `condition ? this : that`"},
    {"n ? 1 : ", "bad-expression", 8, 0, "expected a value after `:`",
     "leave out the `:`, or write a value after it"},
    {"n ? : 2", "bad-expression", 4, 1, "expected a value after `?`, found `:`", NULL},
    {"? 1", "bad-expression", 0, 1, "expected a value, found `?`", NULL},
    {":", "bad-expression", 0, 1, "expected a value, found `:`", NULL},
    {")", "bad-expression", 0, 1, "expected a value, found `)`", NULL},
    {"]", "bad-expression", 0, 1, "expected a value, found `]`", NULL},
    {",", "bad-expression", 0, 1, "expected a value, found `,`", NULL},
    {"[1, 2", "bad-expression", 0, 1, "this `[` is not closed", "add `]`"},
    {"[1, 2)", "bad-expression", 0, 1, "this `[` is not closed", "add `]` before `)`"},
    {"v[0", "bad-expression", 1, 1, "this `[` is not closed", "add `]`"},
    {"v[", "bad-expression", 2, 0, "expected a value after `[`", NULL},
    {"v[]", "bad-expression", 2, 1, "expected a value after `[`, found `]`", NULL},
    {"[]", "bad-expression", 1, 1, "expected a value after `[`, found `]`", NULL},
    {"()", "bad-expression", 1, 1, "expected a value after `(`, found `)`", NULL},
    {"[1,2,3,4,5]", "bad-expression", 0, 11, "a vector has 2 to 4 numbers, found 5", NULL},
    {"n === 3", "bad-expression", 2, 3, "`===` is no operator", "write `==`"},
    {"n !== 3", "bad-expression", 2, 3, "`!==` is no operator", "write `!=`"},
    {"n =< 3", "bad-expression", 2, 2, "`=<` is no operator", "write `<=`"},
    {"n => 3", "bad-expression", 2, 2, "`=>` is no operator", "write `>=`"},
    {"n := 3", "bad-expression", 2, 2, "`:=` is no operator", "write `==`"},
    {"3 \xc3"
     "\x97"
     " 4",
     "bad-expression", 2, 2, "a multiplication sign (U+00D7) is no sign of the language", "write `*`"},
    {"3 \xc3"
     "\xb7"
     " 4",
     "bad-expression", 2, 2, "a division sign (U+00F7) is no sign of the language", "write `/`"},
    {"n \xe2"
     "\x89"
     "\xa4"
     " 4",
     "bad-expression", 2, 3, "a sign (U+2264) is no sign of the language", "write `<=`"},
    {"2 \xcf"
     "\x80"
     "",
     "bad-expression", 2, 2, "a Greek letter is no sign of the language", "write `pi`"},
    {"n\xc2"
     "\xb2"
     "",
     "bad-expression", 1, 2, "a raised 2 is no sign of the language", "write `^2`"},
    {"\xe2"
     "\x88"
     "\x9a"
     "2",
     "bad-expression", 0, 3, "a root (U+221A) is no sign of the language", "write `sqrt(x)`"},
    {"\"a\"", "bad-expression", 0, 1, "a quote has no meaning here",
     "numbers, names and colours stand without quotes"},
    {"'a'", "bad-expression", 0, 1, "a quote has no meaning here",
     "numbers, names and colours stand without quotes"},
    {"{n}", "bad-expression", 0, 1, "`{` has no meaning here", "write the name alone; a vector is [x, y, z]"},
    {"n & 1", "bad-expression", 2, 1, "`&` is no operator", "did you mean `&&`?"},
    {"n | 1", "bad-expression", 2, 1, "`|` is no operator", "did you mean `||`?"},
    {"n ~ 1", "bad-expression", 2, 1, "`~` has no meaning here", NULL},
    {"n ; 1", "bad-expression", 2, 1, "`;` has no meaning here", NULL},
    {"n \\ 1", "bad-expression", 2, 1, "`\\` has no meaning here", NULL},
    {"3..4", "bad-expression", 2, 2, "expected an operator, found `.4`", NULL},
    {"1.2.3", "bad-expression", 3, 2, "expected an operator, found `.3`", NULL},
    {"1,5", "bad-expression", 1, 1, "expected an operator, found `,`",
     "the decimal point is a point: write 1.5"},
    {"1.5,5", "bad-expression", 3, 1, "expected an operator, found `,`", "a vector is written [x, y, z]"},
    {"v.", "bad-expression", 1, 1, "expected a part after `.`", "parts are .x .y .z, .r .g .b and [i]"},
    {"v.3", "bad-expression", 1, 2, "expected an operator, found `.3`", NULL},
    {"v.xy", "bad-expression", 2, 2, "there is no part `xy`", "parts are .x .y .z, .r .g .b and [i]"},
    {"0b101", "bad-expression", 0, 5, "numbers are decimal", "write 5"},
    {"0o17", "bad-expression", 0, 4, "numbers are decimal", "write 15"},
    {"00.5", "leading-zero", 0, 4, "a number with a leading zero",
     "write 0.5; some readers take a leading zero for base 8"},
    {"1__0", "bad-expression", 1, 3, "expected an operator, found `__0`", "to multiply, write `1 * __0`"},
    {"3 \"a\"", "bad-expression", 2, 1, "a quote has no meaning here",
     "numbers, names and colours stand without quotes"},
    {"1 2", "bad-expression", 2, 1, "expected an operator, found `2`", NULL},
    {"(1)(2)", "bad-expression", 3, 1, "expected an operator, found `(`", "to multiply, write `*` between"},
    {"[1,2][1,2]", "bad-expression", 7, 1, "expected an operator or `]`, found `,`",
     "the decimal point is a point: write 1.2"},
    {"n if n else 3", "bad-expression", 2, 2, "expected an operator, found `if`",
     "write `condition ? this : that`"},
    {"steel", "not-a-quantity", 0, 5, "`steel` is no number, vector or colour", NULL},
    {"v + steel", "not-a-quantity", 4, 5, "`steel` is no number, vector or colour", NULL},
    {"undefined_name_that_is_longer_than_forty_bytes + 1", "unknown-variable", 0, 46,
     "nothing here is named `undefined_name_that_is_longer_than_forty...`",
     "in scope: depth, later, n, steel, v, w, zero"},
    {"1 / (zero * (n + 1) * (n + 2) * (n + 3) * (n + 4))", "division-by-zero", 2, 1,
     "division by zero: `zero * (n + 1) * (n + 2) * (n + 3) * (n ...` is 0", NULL},
};

static void assert_text(const char *text, const char *got, const char *want) {
    if (!got != !want || (got && strcmp(got, want) != 0))
        fail_msg("%s: got \"%s\", want \"%s\"", text, got ? got : "-", want ? want : "-");
}

static void check_error(void **state) {
    const struct error_row *row = *state;
    struct arena arena = {0};
    struct expr_error error = {0};
    struct quantity untouched = {7, {7}};
    unsigned asked = 0;
    assert_int_equal(parse_and_evaluate(&arena, row->text, strlen(row->text), &asked, &untouched, &error),
                     EXPR_WRONG);
    assert_text(row->text, error.code, row->code);
    assert_text(row->text, error.message, row->message);
    assert_text(row->text, error.help, row->help);
    if (error.offset != row->offset || error.length != row->length)
        fail_msg("%s: got %zu+%zu, want %zu+%zu", row->text, error.offset, error.length, row->offset,
                 row->length);
    assert_int_equal(untouched.count, 7);
    arena_free(&arena);
}

/* ---- Names ---- */

static void a_name_alone_is_told(void **state) {
    (void)state;
    static const struct {
        const char *text, *name;
    } rows[] = {{"depth", "depth"},  {" (depth) ", "depth"}, {"gold", "gold"},
                {"depth + 0", NULL}, {"#fff", NULL},         {"3", NULL},
                {"v.x", NULL}};
    struct arena arena = {0};
    struct expr_error error;
    for (size_t i = 0; i < COUNT(rows); i++)
        assert_text(rows[i].text, expr_name(expr_parse(&arena, rows[i].text, strlen(rows[i].text), &error)),
                    rows[i].name);
    arena_free(&arena);
}

static void what_is_not_known_yet_is_waited_for(void **state) {
    (void)state;
    static const char *const texts[] = {"later",      "1 + later",  "later ? 1 : 2", "v[later]",
                                        "sin(later)", "[1, later]", "!later",        "later.x",
                                        "1 < later",  "1 && later"};
    struct arena arena = {0};
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct expr_error error = {0};
        struct quantity out;
        unsigned asked = 0;
        if (parse_and_evaluate(&arena, texts[i], strlen(texts[i]), &asked, &out, &error) != EXPR_WAIT)
            fail_msg("%s does not wait", texts[i]);
    }
    arena_free(&arena);
}

static void a_scope_comes_before_constants_and_colors(void **state) {
    (void)state;
    struct arena arena = {0};
    struct expr_error error;
    struct quantity out;
    unsigned asked = 0;
    assert_int_equal(parse_and_evaluate(&arena, "pi + gold.r", 11, &asked, &out, &error), EXPR_OK);
    assert_int_equal(asked, 2);
    arena_free(&arena);
}

static enum expr_result check_text(struct arena *arena, const char *text, struct expr_error *error) {
    unsigned asked = 0;
    const struct expr_scope scope = {&asked, known_find, known_names};
    return expr_check(expr_parse(arena, text, strlen(text), error), &scope, arena, error);
}

static void a_check_looks_at_all_names_and_no_values(void **state) {
    (void)state;
    struct arena arena = {0};
    struct expr_error error = {0};
    assert_int_equal(check_text(&arena, "0 ? n / 0 : later + sqrt(-1) + v[9] + gold", &error), EXPR_OK);
    assert_int_equal(check_text(&arena, "0 ? nobody : 1", &error), EXPR_WRONG);
    assert_text("nobody", error.code, "unknown-variable");
    assert_int_equal(error.offset, 4);
    assert_int_equal(check_text(&arena, "0 && [1, sin(steel)].x", &error), EXPR_WRONG);
    assert_text("steel", error.code, "not-a-quantity");
    arena_free(&arena);
}

static enum expr_found find_nothing(void *context, const char *name, struct quantity *out) {
    (void)context, (void)name, (void)out;
    return EXPR_MISSING;
}

static void many_names(void *context, void (*each)(void *to, const char *name), void *to) {
    static const char *const names[] = {"zz01", "zz03", "zz02", "zz02", "zz05", "zz04", "zz07", "zz06",
                                        "zz09", "zz08", "zz11", "zz10", "zz13", "zz12", "zz14"};
    for (size_t i = 0; i < COUNT(names) * *(unsigned *)context; i++) each(to, names[i % COUNT(names)]);
}

static void names_in_scope_are_sorted_and_few(void **state) {
    (void)state;
    static const struct {
        unsigned times;
        const char *help;
    } rows[] = {
        {0, "no names are in scope here"},
        {1, "in scope: zz01, zz02, zz03, zz04, zz05, zz06, zz07, zz08, zz09, zz10, zz11, zz12, ..."},
        {1000, "in scope: zz01, zz02, zz03, zz04, zz05, zz06, zz07, zz08, zz09, zz10, zz11, zz12, ..."},
    };
    struct arena arena = {0};
    for (size_t i = 0; i < COUNT(rows); i++) {
        unsigned times = rows[i].times;
        const struct expr_scope scope = {&times, find_nothing, many_names};
        struct expr_error error;
        struct quantity out;
        assert_int_equal(expr_evaluate(expr_parse(&arena, "qqqqqq", 6, &error), &scope, &arena, &out, &error),
                         EXPR_WRONG);
        assert_text("qqqqqq", error.help, rows[i].help);
    }
    arena_free(&arena);
}

/* ---- The definition ---- */

static void examples_give_what_they_say(void **state) {
    (void)state;
    struct arena arena = {0};
    unsigned asked = 0;
    for (int i = 0; i < grammar_function_count; i++) {
        const struct grammar_function *f = &grammar_functions[i];
        struct quantity got, want;
        struct expr_error error = {0};
        assert_non_null(f->example);
        if (parse_and_evaluate(&arena, f->example, strlen(f->example), &asked, &got, &error) != EXPR_OK)
            fail_msg("%s: %s", f->example, error.message);
        if (parse_and_evaluate(&arena, f->gives, strlen(f->gives), &asked, &want, &error) != EXPR_OK)
            fail_msg("%s: %s", f->gives, error.message);
        assert_int_equal(got.count, want.count);
        for (unsigned k = 0; k < got.count; k++)
            if (got.v[k] != want.v[k]) fail_msg("%s: got %.17g, want %.17g", f->example, got.v[k], want.v[k]);
    }
    arena_free(&arena);
}

/* ---- What is hostile ---- */

static const char *code_of(const char *text, size_t size) {
    struct arena arena = {0};
    struct expr_error error = {0};
    struct quantity out;
    unsigned asked = 0;
    const enum expr_result result = parse_and_evaluate(&arena, text, size, &asked, &out, &error);
    assert_true(arena.total < 4u << 20);
    if (result == EXPR_OK)
        for (unsigned i = 0; i < out.count; i++) assert_true(isfinite(out.v[i]));
    if (result == EXPR_WRONG) {
        assert_true(error.offset + error.length <= size);
        assert_true(*error.message != '\0');
    }
    const char *code = result == EXPR_WRONG ? error.code : "";
    assert_non_null(code);
    arena_free(&arena);
    return code;
}

/* `count` times `piece`, then `end`. */
static const char *code_of_repeated(const char *piece, size_t count, const char *end) {
    static char text[200000];
    size_t size = 0;
    for (size_t i = 0; i < count; i++) size += (size_t)sprintf(text + size, "%s", piece);
    size += (size_t)sprintf(text + size, "%s", end);
    return code_of(text, size);
}

static void what_is_too_much_is_an_error(void **state) {
    (void)state;
    static const struct {
        const char *piece;
        size_t count;
        const char *end, *code;
    } rows[] = {
        {"1+", 50000, "1", "expression-too-long"},
        {"(", 100000, "", "expression-too-long"},
        {"1", 100000, "", "expression-too-long"},
        {"(", 4000, "", "expression-too-deep"},
        {"-", 4000, "1", "expression-too-deep"},
        {"[", 4000, "", "expression-too-deep"},
        {"sin(", 1000, "", "expression-too-deep"},
        {"2^", 2000, "1", "expression-too-deep"},
        {"1?2:", 1000, "3", "expression-too-deep"},
        {"1?", 2000, "3", "expression-too-deep"},
        {"v[", 2000, "", "expression-too-deep"},
        {"!", 4000, "1", "expression-too-deep"},
        {"-", 100, "1", ""},
        {"-", 101, "1", "expression-too-deep"},
        {"1+", 2047, "1", ""},
        {"1&&", 1365, "1", ""},
        {"2^-", 51, "1", "expression-too-deep"},
        {"9", 4096, "", "too-large"},
        {"a", 4096, "", "unknown-variable"},
        {"1,", 2000, "1", "bad-expression"},
        {"", 0, "", "bad-expression"},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        const char *code = code_of_repeated(rows[i].piece, rows[i].count, rows[i].end);
        if (strcmp(code, rows[i].code) != 0)
            fail_msg("%s x %zu: got `%s`, want `%s`", rows[i].piece, rows[i].count, code, rows[i].code);
    }
}

static void a_zero_byte_is_no_end(void **state) {
    (void)state;
    assert_string_equal(code_of("1\0", 2), "bad-expression");
    assert_string_equal(code_of("1 + \0 2", 7), "bad-expression");
    assert_string_equal(code_of("n\0n", 3), "bad-expression");
}

static void any_bytes_end_well(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 50000; i++) {
        char text[40];
        const size_t size = random_below(&r, sizeof text);
        for (size_t k = 0; k < size; k++) text[k] = (char)random_below(&r, 256);
        code_of(text, size);
    }
}

static void any_words_end_well(void **state) {
    (void)state;
    static const char *const words[] = {
        "1",   "2.5", "0",     "1e300",  "n",    "v", "w", "zero",     "steel",   "later", "nobody",
        "sin", "max", "noise", "random", "(",    ")", "[", "]",        ",",       ".x",    ".",
        "+",   "-",   "*",     "/",      "%",    "^", "!", "<",        "<=",      "==",    "&&",
        "||",  "?",   ":",     "#fff",   "gold", " ", "=", "\xcf\x80", "\xe2\x88"};
    struct random r = random_begin();
    unsigned right = 0;
    for (int i = 0; i < 200000; i++) {
        char text[200] = "";
        const unsigned count = 1 + random_below(&r, 9);
        for (unsigned k = 0; k < count; k++) strcat(text, words[random_below(&r, COUNT(words))]);
        right += *code_of(text, strlen(text)) == '\0';
    }
    assert_true(right > 1000); /* else it is no test */
}

int main(void) {
    static struct CMUnitTest tests[COUNT(values) + COUNT(errors)];
    for (size_t i = 0; i < COUNT(values); i++)
        tests[i] = (struct CMUnitTest){values[i].text, check_value, NULL, NULL, &values[i]};
    for (size_t i = 0; i < COUNT(errors); i++)
        tests[COUNT(values) + i] = (struct CMUnitTest){errors[i].text, check_error, NULL, NULL, &errors[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(a_name_alone_is_told),
        cmocka_unit_test(what_is_not_known_yet_is_waited_for),
        cmocka_unit_test(a_scope_comes_before_constants_and_colors),
        cmocka_unit_test(a_check_looks_at_all_names_and_no_values),
        cmocka_unit_test(names_in_scope_are_sorted_and_few),
        cmocka_unit_test(examples_give_what_they_say),
        cmocka_unit_test(what_is_too_much_is_an_error),
        cmocka_unit_test(a_zero_byte_is_no_end),
        cmocka_unit_test(any_bytes_end_well),
        cmocka_unit_test(any_words_end_well),
    };
    return cmocka_run_group_tests_name("rows", tests, NULL, NULL) +
           cmocka_run_group_tests_name("expressions", others, NULL, NULL);
}
