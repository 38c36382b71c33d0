#include "render/lights.h"

/* A key light above the camera's left shoulder, so far away that it lights an endless floor evenly up to the
 * horizon, and a weak one in its eye, whose shadows it cannot see. */
static struct light *default_lights(struct arena *arena, const struct view *view, uint32_t *count) {
    struct light *lights = arena_array(arena, 2, sizeof *lights);
    const vec3 across =
        vec3_madd(vec3_scale(vec3_normalize(view->right), -0.6), 0.8, vec3_normalize(view->up));
    const vec3 to_key = vec3_scale(vec3_sub(across, view->forward), 1000.0 * view->distance);
    lights[0] = (struct light){LIGHT_POINT, vec3_add(view->eye, to_key), {0.95, 0.93, 0.9}};
    lights[1] = (struct light){LIGHT_POINT, view->eye, {0.15, 0.17, 0.2}};
    *count = 2;
    return lights;
}

void lights_set(struct tracer *tracer, struct arena *arena, const struct view *view) {
    const struct scene *scene = tracer->scene;
    if (scene->default_lights) {
        tracer->lights = default_lights(arena, view, &tracer->light_count);
        tracer->ambient = (vec3){0.12, 0.12, 0.13};
        return;
    }
    struct light *points = arena_array(arena, scene->light_count ? scene->light_count : 1, sizeof *points);
    for (uint32_t i = 0; i < scene->light_count; i++) {
        if (scene->lights[i].kind == LIGHT_POINT)
            points[tracer->light_count++] = scene->lights[i];
        else
            tracer->ambient = vec3_add(tracer->ambient, scene->lights[i].color);
    }
    tracer->lights = points;
}
