/* Golden pictures: what the parts of `monge test` and `monge accept` share. */
#ifndef MONGE_CLI_GOLDEN_GOLDEN_H
#define MONGE_CLI_GOLDEN_GOLDEN_H

#include "monge.h"

enum golden_status {
    GOLDEN_SAME,
    GOLDEN_CHANGED, /* the picture is not that of the golden */
    GOLDEN_NEW,     /* there is no golden yet */
    GOLDEN_MISSING, /* there ought to be one: half of it is there, or it cannot be read */
    GOLDEN_ORPHAN,  /* a golden whose scene is gone */
    GOLDEN_BROKEN, /* there is no picture: the scene is wrong, or its options do not fit it; or no place for a golden */
    GOLDEN_STATUSES
};
extern const char *const GOLDEN_STATUS[GOLDEN_STATUSES]; /* "same", ... */
extern const char *const GOLDEN_KIND[];                  /* "png", "hash", "both" */

/* The layers whose hashes a golden may have: the first two are geometry. */
enum { GOLDEN_LAYERS = 3 };
extern const enum monge_layer GOLDEN_LAYER[GOLDEN_LAYERS]; /* depth, normal, shadow */

/* A picture in hashes; "" is what is not known. */
struct golden_stamp {
    char pixels[MONGE_HASH_SIZE], scene[MONGE_HASH_SIZE], text[MONGE_HASH_SIZE], program[MONGE_HASH_SIZE];
    char layers[GOLDEN_LAYERS][MONGE_HASH_SIZE]; /* of what is seen: by GOLDEN_LAYER */
    char *options;                               /* owned; as asked_text has them; NULL: not known */
    uint32_t width, height;
    unsigned bits;
};

/* One picture that has a golden or is to have one. Texts and paths are owned, NULL where there is none. */
struct golden_case {
    char *name;               /* of the golden */
    char *scene, *scene_name; /* the path of the scene, and its name; NULL of an orphan */
    char *rule_options;       /* as golden.yaml has them */
    enum monge_golden_kind kind;
    enum golden_status status;
    bool aov; /* it has passes */
    bool
        unchanged; /* not rendered: its inputs are the golden's, or those of a run in which it was the same */
    bool within;   /* the same but for a tolerance */
    bool taken;    /* the golden is the new picture now */
    bool trouble;  /* the system failed, not the scene */
    char *message; /* why it has its status, perhaps in many lines */
    struct golden_stamp now, old;      /* the scene's, and the golden's */
    char golden_file[MONGE_HASH_SIZE]; /* of the file of a golden that is a picture; "": there was none */
    char *golden_line;                 /* of the golden in the lock; NULL: there was none */
    char *golden_path, *new_path;      /* of pictures that are there to be looked at */
    struct monge_tolerance tolerance;  /* its reason owned; NULL: none */
    char *tolerance_text;              /* as golden_tolerance_text has it */
    bool compared;                     /* with the picture of the golden: */
    struct monge_difference difference;
    char **changes; /* what changed, in sentences */
    size_t change_count;
    char *arguments;             /* of `monge render` for the picture, as a shell takes them */
    bool has_frames;             /* --frames is one of them */
    char *command, *old_command; /* to make the picture, and the one of the golden, again */
    char *prune_command;         /* of an orphan: to remove all of them */
    double seconds;
};

void golden_stamp_free(struct golden_stamp *stamp);
void golden_case_free(struct golden_case *c);

/* What of the inputs is that of the golden. */
struct monge_causes golden_causes(const struct golden_case *c);

/* "at most 0.1% of the pixels by over 0.004, flip at most 0.01"; "at most 5 pixels" may differ. To be freed. */
char *golden_tolerance_text(const struct monge_tolerance *tolerance);

/* "psnr 72.1, flip 0.021": what of the difference is beyond the tolerance of the case. To be freed; NULL: it has none, or is
 * not compared with it. */
char *golden_beyond_text(const struct golden_case *c);

/* "1204 of 24576 pixels, by up to 0.31, flip 0.021"; of a case that is compared. To be freed. */
char *golden_difference_text(const struct golden_case *c);

/* "the scene's text differs; the options and the program are the same"; NULL: nothing is known of the golden. To
 * be freed. */
char *golden_causes_text(const struct golden_case *c);

/* Whether the difference is within the tolerance. */
bool golden_tolerates(const struct monge_tolerance *tolerance, const struct monge_difference *difference);

#endif
