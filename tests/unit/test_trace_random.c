/* Shading and optics of random scenes, by pictures of one pixel, against closed forms: Phong's model, and the paths of
 * light through shells and slabs, which follow from what stays the same along them. MONGE_SEED=n repeats a run. */
#include <string.h>

#include "monge.h"
#include "near.h"

static const double pi = 3.14159265358979323846;

struct scene_text {
    char bytes[6000];
    size_t used;
};

__attribute__((format(printf, 2, 3))) static void say(struct scene_text *text, const char *form, ...) {
    va_list list;
    va_start(list, form);
    const int length = vsnprintf(text->bytes + text->used, sizeof text->bytes - text->used, form, list);
    va_end(list);
    assert_true(length >= 0 && (text->used += (size_t)length) < sizeof text->bytes);
}

static void say_vec3(struct scene_text *text, const char *key, vec3 v) {
    say(text, "%s: [%.17g, %.17g, %.17g]", key, v.x, v.y, v.z);
}

/* What the file begins with: a ray from `eye`, and no light. */
static void say_view(struct scene_text *text, vec3 eye, vec3 dir, const char *background) {
    *text = (struct scene_text){0};
    say(text, "image: {size: [1, 1], samples: 1, background: %s}\n", background);
    say_vec3(text, "camera: {eye", eye);
    say_vec3(text, ", direction", dir);
    say(text, "}\n");
}

static vec3 color_of(const struct scene_text *text) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("probe", text->bytes, text->used, NULL, diag);
    if (!scene) printf("%s\n", text->bytes);
    monge_diagnostics_print(diag, stderr);
    assert_non_null(scene);
    const struct monge_settings settings = monge_scene_settings(scene);
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
    assert_non_null(film);
    const float *rgb = monge_film_pixels(film);
    const vec3 color = {(double)rgb[0], (double)rgb[1], (double)rgb[2]};
    monge_film_free(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    return color;
}

static vec3 random_unit(struct random *r) {
    for (;;) {
        const vec3 v = random_vec3(r, -1, 1);
        const double length = sqrt(vec3_dot(v, v));
        if (length < 1 && length > 0.1) return vec3_scale(v, 1 / length);
    }
}

static vec3 unit(vec3 v) { return vec3_scale(v, 1 / sqrt(vec3_dot(v, v))); }

/* ---- Phong's model ---- */

struct lamp {
    vec3 at, color;
};

struct phong {
    vec3 ambient, diffuse, specular, light; /* light: the ambient one */
    double shininess, shadow;
    struct lamp lamps[3];
    int lamp_count;
    vec3
        veil; /* a small ball of glass somewhere between the point and the first lamp, not in the camera's way */
    double veil_radius, clear;
};

static bool passes(vec3 from, vec3 to, vec3 center, double radius) {
    const vec3 dir = unit(vec3_sub(to, from)), out = vec3_sub(center, from);
    const double along = vec3_dot(out, dir), length = sqrt(vec3_dot(vec3_sub(to, from), vec3_sub(to, from)));
    return along > 0 && along < length && vec3_dot(out, out) - along * along < radius * radius;
}

static vec3 phong_color(const struct phong *p, vec3 point, vec3 normal, vec3 dir) {
    vec3 sum = vec3_mul(p->ambient, p->light);
    for (int i = 0; i < p->lamp_count; i++) {
        const struct lamp *lamp = &p->lamps[i];
        const vec3 to = unit(vec3_sub(lamp->at, point));
        const double cosine = vec3_dot(normal, to);
        if (cosine <= 0) continue;
        const vec3 half = vec3_sub(vec3_scale(normal, 2 * cosine), to); /* the light's mirror image */
        const double glance = -vec3_dot(half, dir);
        const double highlight = glance > 0 ? pow(glance, p->shininess) : 0;
        const double veil = passes(point, lamp->at, p->veil, p->veil_radius) ? p->clear * p->clear : 1;
        const double lit = p->shadow + (1 - p->shadow) * veil;
        const vec3 own = vec3_madd(vec3_scale(p->diffuse, cosine), highlight, p->specular);
        sum = vec3_madd(sum, lit, vec3_mul(own, lamp->color));
    }
    return sum;
}

static struct phong random_phong(struct random *r, vec3 around) {
    struct phong p = {.ambient = random_vec3(r, 0, 1),
                      .diffuse = random_vec3(r, 0, 1),
                      .specular = random_vec3(r, 0, 1),
                      .light = random_vec3(r, 0, 1),
                      .shininess = random_below(r, 4) ? random_between(r, 0, 30) : 0,
                      .shadow = random_below(r, 3) ? 0 : random_between(r, 0, 1),
                      .lamp_count = 1 + (int)random_below(r, 3),
                      .veil_radius = 0.2,
                      .clear = random_between(r, 0.3, 1)};
    for (int i = 0; i < p.lamp_count; i++)
        p.lamps[i] = (struct lamp){vec3_add(around, random_vec3(r, -9, 9)), random_vec3(r, 0, 2)};
    return p;
}

static void say_phong(struct scene_text *text, const struct phong *p) {
    say(text, "  - {sphere: {radius: %.17g, ", p->veil_radius);
    say_vec3(text, "center", p->veil);
    say(text, "}, material: {diffuse: black, specular: black, refraction: %.17g, index: 1.5}}\n", p->clear);
    say_vec3(text, "materials: {m: {ambient", p->ambient);
    say_vec3(text, ", diffuse", p->diffuse);
    say_vec3(text, ", specular", p->specular);
    say(text, ", shininess: %.17g}}\nrender: {shadow: %.17g}\n", p->shininess, p->shadow);
    say_vec3(text, "lights:\n  - ambient: {color", p->light);
    say(text, "}\n");
    for (int i = 0; i < p->lamp_count; i++) {
        say_vec3(text, "  - point: {at", p->lamps[i].at);
        say_vec3(text, ", color", p->lamps[i].color);
        say(text, "}\n");
    }
}

/* Whether what the veil does is certain: it is not cut by the surface, nothing is in it, and no ray grazes it. */
static bool veil_is_clear_of(const struct phong *p, vec3 point, vec3 normal, vec3 dir) {
    const double small = 0.95 * p->veil_radius, large = 1.05 * p->veil_radius;
    if (fabs(vec3_dot(vec3_sub(p->veil, point), normal)) < large) return false;
    if (passes(point, vec3_madd(point, -9, dir), p->veil, large)) return false;
    for (int i = 0; i < p->lamp_count; i++) {
        if (vec3_length(vec3_sub(p->lamps[i].at, p->veil)) < large) return false;
        if (passes(point, p->lamps[i].at, p->veil, small) != passes(point, p->lamps[i].at, p->veil, large))
            return false;
    }
    return true;
}

/* A point of a plane or a ball, from either side of the plane. */
static void shaded_as_phong_says(void **state) {
    (void)state;
    struct random r = random_begin();
    int tried = 0;
    for (int i = 0; i < 400; i++) {
        const vec3 normal = random_unit(&r), point = random_vec3(&r, -3, 3);
        vec3 dir = random_unit(&r);
        if (fabs(vec3_dot(dir, normal)) < 0.05) continue;
        const bool ball = random_below(&r, 2);
        if (vec3_dot(dir, normal) > 0 && ball) dir = vec3_neg(dir);
        const vec3 seen = vec3_dot(dir, normal) > 0 ? vec3_neg(normal) : normal;
        struct phong p = random_phong(&r, point);
        const vec3 eye = vec3_madd(point, -random_between(&r, 1, 5), dir);
        p.veil = vec3_madd(point, random_between(&r, 0.3, 0.7), vec3_sub(p.lamps[0].at, point));
        if (!veil_is_clear_of(&p, point, normal, dir)) continue;
        struct scene_text text;
        say_view(&text, eye, dir, "black");
        say(&text, "scene:\n");
        if (ball) {
            const double radius = random_between(&r, 0.5, 3);
            say(&text, "  - {material: m, sphere: {radius: %.17g, ", radius);
            say_vec3(&text, "center", vec3_madd(point, -radius, normal));
        } else {
            say_vec3(&text, "  - {material: m, plane: {point", point);
            say_vec3(&text, ", normal", normal);
        }
        say(&text, "}}\n");
        say_phong(&text, &p);
        assert_vec3_near(color_of(&text), phong_color(&p, point, seen, dir), 2e-6, "color");
        tried++;
    }
    assert_true(tried > 200);
}

/* ---- Balls in balls ----
 * About one centre n r sin(angle to the radius) stays the same along the whole path (Bouguer), so the direction in which
 * it leaves is a sum of angles; the background tells that direction, and how many surfaces took their part. */

enum { SHELLS_MAX = 5 };

struct shells {
    int count;
    vec3 center;
    double radius[SHELLS_MAX], index[SHELLS_MAX]; /* from the outermost */
    bool quadric[SHELLS_MAX];
    double clear;
};

struct flight {
    double turn; /* towards the centre */
    int surfaces;
    bool trapped, doubtful;
};

static double index_within(const struct shells *s, int inside) { return inside ? s->index[inside - 1] : 1.0; }

/* One surface: whether the ray passes it. */
static bool pass(struct flight *f, double constant, double radius, double from, double to) {
    const double before = constant / (from * radius), after = constant / (to * radius);
    f->doubtful |= fabs(after - 1) < 1e-3 || fabs(before - 1) < 1e-3;
    f->surfaces++;
    f->turn += after < 1 ? asin(before) - asin(after) : 0;
    return after < 1;
}

/* `inside`: how many balls hold the eye. */
static struct flight fly(const struct shells *s, int inside, double constant, bool inwards) {
    struct flight f = {0};
    while (inwards && inside < s->count) {
        const double radius = s->radius[inside], here = index_within(s, inside);
        f.doubtful |= fabs(constant / (here * radius) - 1) < 1e-3;
        if (constant / (here * radius) > 1) break; /* it passes the ball by */
        if (!pass(&f, constant, radius, here, index_within(s, inside + 1))) {
            f.turn -= pi - 2 * asin(constant / (here * radius)); /* a mirror */
            break;
        }
        inside++;
    }
    while (inside > 0) {
        const double radius = s->radius[inside - 1], here = index_within(s, inside);
        const double beyond = index_within(s, inside - 1);
        if (constant / (beyond * radius) < 1)
            pass(&f, constant, radius, beyond, here); /* as on the way in */
        else
            f.trapped = true; /* mirrored for ever */
        f.doubtful |= fabs(constant / (beyond * radius) - 1) < 1e-3;
        if (f.trapped) break;
        inside--;
    }
    return f;
}

static struct shells random_shells(struct random *r) {
    struct shells s = {
        .count = 1 + (int)random_below(r, SHELLS_MAX), .center = random_vec3(r, -5, 5), .clear = 0.97};
    double radius = random_between(r, 1, 4);
    for (int i = 0; i < s.count; i++) {
        s.radius[i] = radius;
        s.index[i] = random_below(r, 5) ? random_between(r, 0.7, 2.2) : 1;
        s.quadric[i] = random_below(r, 3) == 0;
        radius *= random_between(r, 0.6, 0.95);
    }
    return s;
}

/* In any order. */
static void say_shells(struct random *r, struct scene_text *text, const struct shells *s) {
    const int first = (int)random_below(r, (unsigned)s->count), step = random_below(r, 2) ? 1 : s->count - 1;
    say(text, "render: {depth: 40}\nlights: []\nscene:\n");
    for (int k = 0; k < s->count; k++) {
        const int i = (first + k * step) % s->count;
        say(text, "  - {material: {diffuse: black, refraction: %.17g, index: %.17g}, ", s->clear,
            s->index[i]);
        if (s->quadric[i])
            say(text, "quadric: {xx: 1, yy: 1, zz: 1, constant: -1}, transform: [{scale: %.17g}, {",
                s->radius[i]);
        else
            say(text, "sphere: {radius: %.17g}, transform: [{", s->radius[i]);
        say_vec3(text, "translate", s->center);
        say(text, "}]}\n");
    }
}

static void through_balls_in_balls(void **state) {
    (void)state;
    struct random r = random_begin();
    int tried = 0, trapped = 0, turned = 0;
    for (int i = 0; i < 1500; i++) {
        const struct shells s = random_shells(&r);
        const double away = random_between(&r, 0.1, 1.5) * s.radius[0];
        const vec3 out = random_unit(&r), eye = vec3_madd(s.center, away, out);
        const vec3 near = vec3_madd(s.center, 0.9 * s.radius[0], random_unit(&r));
        const vec3 dir = random_below(&r, 3) ? unit(vec3_sub(near, eye)) : random_unit(&r);
        int inside = 0;
        while (inside < s.count && s.radius[inside] > away) inside++;
        const vec3 side =
            vec3_sub(vec3_scale(dir, vec3_dot(out, dir)), out); /* square to dir, to the centre's side */
        const double constant = index_within(&s, inside) * away * sqrt(vec3_dot(side, side));
        const struct flight f = fly(&s, inside, constant, vec3_dot(out, dir) < 0);
        if (f.doubtful) continue;
        struct scene_text text;
        say_view(&text, eye, dir, "{bottom: black, top: [1, 0.5, 0.25]}");
        say_shells(&r, &text, &s);
        const vec3 leaves = vec3_madd(vec3_scale(dir, cos(f.turn)), sin(f.turn), unit(side));
        const double light = f.trapped ? 0 : 0.5 * (1 + leaves.y) * pow(s.clear, f.surfaces);
        const vec3 want = {light, 0.5 * light, 0.25 * light}, got = color_of(&text);
        if (vec3_max_abs(vec3_sub(got, want)) > 1e-6) printf("%s\n", text.bytes);
        assert_vec3_near(got, want, 1e-6, "the sky");
        tried++;
        trapped += f.trapped;
        turned += fabs(f.turn) > 0.1;
    }
    printf("# %d tried, %d turned, %d trapped\n", tried, turned, trapped);
    assert_true(tried > 1000 && turned > 500 && trapped > 20);
}

/* ---- Slabs that overlap ----
 * n sin(angle to z) stays the same through them all; how far the ray goes aside in each is its tangent. Which body counts
 * where several are is told by their order: the one entered last, of those around the eye the one that is left first. */

enum { SLABS_MAX = 6, FLOOR = -10 };

struct slab {
    double top, bottom, index; /* top is infinite for a plane that faces down, bottom for one that faces up */
};

/* How far aside the ray is at the floor. */
static double drift(const struct slab *slabs, int count, double z, double constant) {
    int stack[SLABS_MAX], depth = 0;
    for (;;) { /* those around, by where they end: the last to end is the outermost */
        int next = -1;
        for (int i = 0; i < count; i++) {
            bool known = !(slabs[i].bottom < z && z < slabs[i].top);
            for (int k = 0; k < depth; k++) known |= stack[k] == i;
            if (!known && (next < 0 || slabs[i].bottom < slabs[next].bottom)) next = i;
        }
        if (next < 0) break;
        stack[depth++] = next;
    }
    double aside = 0;
    while (z > FLOOR) {
        double to = FLOOR;
        int at = -1;
        bool in = false;
        for (int i = 0; i < count; i++) {
            if (slabs[i].top < z && slabs[i].top > to) to = slabs[i].top, at = i, in = true;
            if (slabs[i].bottom < z && slabs[i].bottom > to) to = slabs[i].bottom, at = i, in = false;
        }
        const double sine = constant / (depth ? slabs[stack[depth - 1]].index : 1.0);
        aside += (z - to) * sine / sqrt(1 - sine * sine);
        z = to;
        if (at < 0) break;
        if (in) {
            stack[depth++] = at;
        } else {
            int kept = 0;
            for (int k = 0; k < depth; k++)
                if (stack[k] != at) stack[kept++] = stack[k];
            depth = kept;
        }
    }
    return aside;
}

static double index_at(const struct slab *slabs, int count, double z) {
    int inner = -1;
    for (int i = 0; i < count; i++)
        if (slabs[i].bottom < z && z < slabs[i].top && (inner < 0 || slabs[i].bottom >= slabs[inner].bottom))
            inner = i;
    return inner < 0 ? 1.0 : slabs[inner].index;
}

static void say_slab(struct scene_text *text, const struct slab *s, bool placed) {
    say(text, "  - {material: {diffuse: black, refraction: 1, index: %.17g}, ", s->index);
    if (isinf(s->top))
        say(text, "plane: {point: [0, 0, %.17g], normal: [0, 0, -1]}}\n", s->bottom);
    else if (isinf(s->bottom))
        say(text, "plane: {point: [0, 0, %.17g]}}\n", s->top);
    else if (placed)
        say(text, "box: {}, transform: [{scale: [100, 100, %.17g]}, {translate: [0, 0, %.17g]}]}\n",
            s->top - s->bottom, 0.5 * (s->top + s->bottom));
    else
        say(text, "box: {min: [-60, -50, %.17g], max: [50, 60, %.17g]}}\n", s->bottom, s->top);
}

/* The floor is lit from (-5, 0, FLOOR + 5) without shadows: Lambert's cosine tells how far aside it is met. */
static void through_slabs_that_overlap(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 600; i++) {
        struct slab slabs[SLABS_MAX];
        const int count = 1 + (int)random_below(&r, SLABS_MAX);
        for (int k = 0; k < count; k++) {
            const double bottom = random_between(&r, FLOOR + 0.5, 1.5),
                         thickness = random_between(&r, 0.2, 5);
            const unsigned kind = random_below(&r, 8);
            slabs[k] = (struct slab){kind == 0 ? INFINITY : bottom + thickness,
                                     kind == 1 ? -INFINITY : bottom, random_between(&r, 1, 2)};
        }
        const double z = random_between(&r, -4, 4), slope = random_between(&r, 0.01, 0.5);
        const double constant = index_at(slabs, count, z) * slope / sqrt(1 + slope * slope);
        if (constant > 0.95) continue;
        struct scene_text text;
        say_view(&text, (vec3){0, 0, z}, (vec3){slope, 0, -1}, "black");
        say(&text, "render: {shadow: 1, depth: 40}\nlights: [{point: {at: [-5, 0, %d]}}]\nscene:\n",
            FLOOR + 5);
        say(&text, "  - {plane: {point: [0, 0, %d]}, material: {diffuse: white, specular: black}}\n", FLOOR);
        for (int k = 0; k < count; k++) say_slab(&text, &slabs[k], random_below(&r, 2));
        const double aside = drift(slabs, count, z, constant);
        assert_near(color_of(&text).x, 5 / sqrt(25 + (aside + 5) * (aside + 5)), 1e-6, "the floor");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shaded_as_phong_says),
        cmocka_unit_test(through_balls_in_balls),
        cmocka_unit_test(through_slabs_that_overlap),
    };
    return cmocka_run_group_tests_name("trace_random", tests, NULL, NULL);
}
