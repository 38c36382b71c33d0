#include "render/camera.h"

#include "base/elementary.h"
#include "shape/shape.h"

static const vec3 default_direction = {-0.45, -0.38, -1.0}; /* from in front, above and right */
static const double margin = 1.25;                          /* around a framed scene */

/* What a picture should show: a box, and a ball about the middle of interest that holds the scene. */
struct frame {
    box3 box;
    vec3 middle;
    double radius;
};

static double primitive_reach(const struct primitives *p, uint32_t number, vec3 middle) {
    const primitive_ref ref = p->info[number].ref;
    if (primitive_ref_kind(ref) == PRIMITIVE_SPHERE) {
        const struct sphere *sphere = &p->spheres[primitive_ref_index(ref)];
        return vec3_length(vec3_sub(sphere->center, middle)) + sphere->radius;
    }
    const box3 box = shape_bounds(p, ref);
    if (!box3_is_bounded(box)) return 0.0;
    const vec3 low = vec3_abs(vec3_sub(box.min, middle)), high = vec3_abs(vec3_sub(box.max, middle));
    return vec3_length((vec3){box3_upper(low.x, high.x), box3_upper(low.y, high.y), box3_upper(low.z, high.z)});
}

static struct frame frame_of(const struct scene *scene, box3 bounds) {
    const struct camera *camera = &scene->camera;
    struct frame frame = {.box = box3_is_bounded(bounds) ? bounds : (box3){{-1, -1, -1}, {1, 1, 1}}};
    frame.middle = camera->has_look_at ? camera->look_at : box3_center(frame.box);
    for (uint32_t i = 0; i < scene->primitives.count; i++)
        frame.radius = box3_upper(frame.radius, primitive_reach(&scene->primitives, i, frame.middle));
    if (!(frame.radius > 0.0)) frame.radius = 1.0;
    return frame;
}

static vec3 corner(box3 box, int i) {
    return (vec3){i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
}

/* Axes of length one with `forward` as given; `up` where the camera leaves it open for a view
 * straight up or down. */
static void set_axes(struct view *view, const struct camera *camera, vec3 forward) {
    view->forward = vec3_normalize(forward);
    view->right = vec3_cross(view->forward, vec3_normalize(camera->up));
    if (vec3_length(view->right) < 1e-9) view->right = vec3_cross(view->forward, (vec3){0, 0, -1});
    if (vec3_length(view->right) < 1e-9) view->right = (vec3){1, 0, 0};
    view->right = vec3_normalize(view->right);
    view->up = vec3_cross(view->right, view->forward);
}

/* The least distance from the middle at which a perspective camera sees the whole box, or the whole
 * ball if that is nearer; tan_x, tan_y are the half widths of the view at distance one. */
static double framing_distance(const struct view *view, const struct frame *frame, double tan_x, double tan_y) {
    double box_needs = 0.0;
    for (int i = 0; i < 8; i++) {
        const vec3 p = vec3_sub(corner(frame->box, i), frame->middle);
        const double x = fabs(vec3_dot(p, view->right)) / tan_x, y = fabs(vec3_dot(p, view->up)) / tan_y;
        box_needs = box3_upper(box_needs, margin * box3_upper(x, y) - vec3_dot(p, view->forward));
    }
    const double least = box3_lower(tan_x, tan_y);
    const double ball_needs = margin * frame->radius * sqrt(1.0 + 1.0 / (least * least));
    return box3_lower(box_needs, ball_needs);
}

/* Half the height of an orthographic view that frames the scene. */
static double framing_height(const struct view *view, const struct frame *frame, vec3 from, double aspect) {
    double box_needs = 0.0;
    for (int i = 0; i < 8; i++) {
        const vec3 p = vec3_sub(corner(frame->box, i), from);
        box_needs = box3_upper(box_needs, box3_upper(fabs(vec3_dot(p, view->right)) / aspect, fabs(vec3_dot(p, view->up))));
    }
    const vec3 away = vec3_sub(frame->middle, from);
    const double aside = box3_upper(fabs(vec3_dot(away, view->right)), fabs(vec3_dot(away, view->up)));
    return margin * box3_lower(box_needs, (aside + frame->radius) / box3_lower(aspect, 1.0));
}

static vec3 view_direction(const struct camera *camera, const struct frame *frame) {
    if (camera->has_direction) return camera->direction;
    if (!camera->has_eye) return default_direction;
    const vec3 to_middle = vec3_sub(frame->middle, camera->eye);
    return vec3_max_abs(to_middle) > 0.0 ? to_middle : (vec3){0, 0, -1};
}

struct view camera_view(const struct scene *scene, box3 bounds, uint32_t width, uint32_t height) {
    const struct camera *camera = &scene->camera;
    const struct frame frame = frame_of(scene, bounds);
    const double aspect = (double)width / (double)height;
    const double tan_y = elementary_tan_deg(0.5 * camera->fov_deg), tan_x = tan_y * aspect;
    struct view view = {.orthographic = camera->projection == CAMERA_ORTHOGRAPHIC};
    set_axes(&view, camera, view_direction(camera, &frame));

    view.distance = view.orthographic ? 2.0 * frame.radius : framing_distance(&view, &frame, tan_x, tan_y);
    if (camera->has_eye) view.distance = vec3_length(vec3_sub(frame.middle, camera->eye));
    view.eye = camera->has_eye ? camera->eye : vec3_madd(frame.middle, -view.distance, view.forward);

    const double half = !view.orthographic   ? tan_y
                        : camera->has_height ? 0.5 * camera->height
                                             : framing_height(&view, &frame, view.eye, aspect);
    view.right = vec3_scale(view.right, half * aspect);
    view.up = vec3_scale(view.up, half);
    return view;
}
