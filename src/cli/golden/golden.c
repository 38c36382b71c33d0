#include "cli/golden/golden.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/say.h"

const char *const GOLDEN_STATUS[] = {"same", "changed", "new", "missing", "orphan", "broken"};
const char *const GOLDEN_KIND[] = {"png", "hash", "both"};
const enum monge_layer GOLDEN_LAYER[] = {MONGE_LAYER_DEPTH, MONGE_LAYER_NORMAL, MONGE_LAYER_SHADOW};

void golden_stamp_free(struct golden_stamp *stamp) {
    free(stamp->options);
    stamp->options = NULL;
}

void golden_case_free(struct golden_case *c) {
    char *const owned[] = {c->name,           c->scene,        c->rule_options,
                           c->message,        c->golden_path,  c->new_path,
                           c->command,        c->old_command,  (char *)c->tolerance.reason,
                           c->tolerance_text, c->arguments,    c->scene_name,
                           c->golden_line,    c->prune_command};
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++) free(owned[i]);
    for (size_t i = 0; i < c->change_count; i++) free(c->changes[i]);
    free(c->changes);
    golden_stamp_free(&c->now);
    golden_stamp_free(&c->old);
}

/* ---- Causes ---- */

static const char *known(const char *hash) { return *hash ? hash : NULL; }

static struct monge_stamp stamp_of(const struct golden_stamp *s) {
    return (struct monge_stamp){known(s->program), known(s->scene), known(s->text), s->options};
}

struct monge_causes golden_causes(const struct golden_case *c) {
    const struct monge_stamp old = stamp_of(&c->old), now = stamp_of(&c->now);
    return monge_causes(&old, &now);
}

char *golden_causes_text(const struct golden_case *c) {
    char text[400];
    const struct monge_causes causes = golden_causes(c);
    if (!*c->old.text) return NULL;
    monge_causes_text(&causes, text, sizeof text);
    return say_text("%s", text);
}

/* ---- Differences ---- */

/* `text` with one more part. */
static char *with_part(char *text, char *part) {
    char *longer = say_text("%s%s%s", text, *text ? ", " : "", part);
    free(text);
    free(part);
    return longer;
}

/* Where any difference counts there is no bound to tell. */
static char *over_text(const struct monge_tolerance *t) {
    return t->max > 0.0 ? say_text(" by over %.12g", t->max) : say_text("%s", "");
}

static const char *pixels_word(const struct monge_tolerance *t, double count) {
    return t->percent ? "% of the pixels" : count == 1.0 ? " pixel" : " pixels";
}

char *golden_tolerance_text(const struct monge_tolerance *t) {
    char *text = say_text("%s", ""), *over = over_text(t);
    if (!isnan(t->max) && t->pixels > 0.0)
        text = with_part(text, say_text("at most %.12g%s%s", t->pixels, pixels_word(t, t->pixels), over));
    else if (!isnan(t->max))
        text = with_part(text, say_text("no pixel%s", over));
    free(over);
    if (!isnan(t->mae)) text = with_part(text, say_text("mae at most %.12g", t->mae));
    if (!isnan(t->rmse)) text = with_part(text, say_text("rmse at most %.12g", t->rmse));
    if (!isnan(t->psnr)) text = with_part(text, say_text("psnr at least %.12g", t->psnr));
    if (!isnan(t->ssim)) text = with_part(text, say_text("ssim at least %.12g", t->ssim));
    if (!isnan(t->flip)) text = with_part(text, say_text("flip at most %.12g", t->flip));
    return text;
}

char *golden_difference_text(const struct golden_case *c) {
    const struct monge_difference *d = &c->difference;
    switch (d->unlike) {
    case MONGE_UNLIKE_SIZE:
        return say_text("another size: %ux%u, the golden %ux%u", c->now.width, c->now.height, c->old.width,
                        c->old.height);
    case MONGE_UNLIKE_COLOR_SPACE: return say_text("another colour space");
    case MONGE_UNLIKE_BITS:
    case MONGE_UNLIKE_NOTHING: break;
    }
    char *text = say_text("%s", "");
    if (d->unlike == MONGE_UNLIKE_BITS) text = with_part(text, say_text("other bits a channel"));
    text = with_part(text, say_text("%llu of %llu pixels, by up to %.3g", (unsigned long long)d->different,
                                    (unsigned long long)d->pixels, d->max));
    if (!isnan(d->flip)) text = with_part(text, say_text("flip %.3g", d->flip));
    return text;
}

/* NaN, as a difference or as a bound that is not met by it, is never within. */
static bool at_most(double bound, double value) { return isnan(bound) || value <= bound; }
static bool at_least(double bound, double value) { return isnan(bound) || value >= bound; }

static double pixels_allowed(const struct monge_tolerance *t, const struct monge_difference *d) {
    return t->percent ? t->pixels / 100.0 * (double)d->pixels : t->pixels;
}

bool golden_tolerates(const struct monge_tolerance *t, const struct monge_difference *d) {
    if (!t->reason || d->unlike != MONGE_UNLIKE_NOTHING || isnan(d->max)) return false;
    if (!isnan(t->max) && (double)d->beyond > pixels_allowed(t, d)) return false;
    return at_most(t->mae, d->mae) && at_most(t->rmse, d->rmse) && at_most(t->flip, d->flip) &&
           at_least(t->psnr, d->psnr) && at_least(t->ssim, d->ssim);
}

static char *with_metric(char *text, bool within, const char *name, double value) {
    return within ? text : with_part(text, say_text("%s %.6g", name, value));
}

static char *with_pixels(char *text, const struct monge_tolerance *t, const struct monge_difference *d) {
    const double percent = 100.0 * (double)d->beyond / (double)(d->pixels ? d->pixels : 1);
    if (isnan(t->max) || (double)d->beyond <= pixels_allowed(t, d)) return text;
    const double count = t->percent ? percent : (double)d->beyond;
    char *over = over_text(t);
    text = with_part(text, say_text("%.*g%s%s", t->percent ? 6 : 12, count, pixels_word(t, count), over));
    free(over);
    return text;
}

char *golden_beyond_text(const struct golden_case *c) {
    const struct monge_tolerance *t = &c->tolerance;
    const struct monge_difference *d = &c->difference;
    if (!c->compared || c->status != GOLDEN_CHANGED || !c->tolerance_text ||
        d->unlike != MONGE_UNLIKE_NOTHING)
        return NULL;
    char *text = with_pixels(say_text("%s", ""), t, d);
    text = with_metric(text, at_most(t->mae, d->mae), "mae", d->mae);
    text = with_metric(text, at_most(t->rmse, d->rmse), "rmse", d->rmse);
    text = with_metric(text, at_least(t->psnr, d->psnr), "psnr", d->psnr);
    text = with_metric(text, at_least(t->ssim, d->ssim), "ssim", d->ssim);
    return with_metric(text, at_most(t->flip, d->flip), "flip", d->flip);
}
