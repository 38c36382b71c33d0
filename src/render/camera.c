#include "render/camera.h"

#include "base/elementary.h"

static const vec3 default_direction = {-0.45, -0.38, -1.0}; /* from in front, above and right */
static const double margin = 1.2;                           /* of the picture around a framed scene */

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

/* ---- Framing: where to stand so that all bounded primitives are in the picture ---- */

/* How far the bounded primitives reach along the direction; a unit ball stands for none. */
static double reach(const struct accel *accel, vec3 direction) {
    const double most = accel_support(accel, direction);
    return most > -INFINITY ? most : vec3_length(direction);
}

/* The place along one axis of the picture, and how far back, from which the two sides of a view with
 * half width `tangent` at distance one just hold the scene. A side with the normal n holds it where
 * n . eye >= reach(n); the two are n = +-axis - tangent forward. With `through`, a point to keep in
 * the middle, `place` is its own. `back` is along -forward from the origin. */
static void stand(const struct accel *accel, const struct view *view, vec3 axis, double tangent,
                  const vec3 *through, double *place, double *back) {
    const vec3 inward = vec3_scale(view->forward, -tangent);
    const double high = reach(accel, vec3_add(inward, axis)), low = reach(accel, vec3_sub(inward, axis));
    *place = through ? vec3_dot(*through, axis) : 0.5 * (high - low);
    *back = box3_upper(high - *place, low + *place) / tangent;
}

static vec3 perspective_eye(const struct accel *accel, const struct view *view, double tan_x, double tan_y,
                            const vec3 *through) {
    double x, y, back_x, back_y;
    stand(accel, view, view->right, tan_x / margin, through, &x, &back_x);
    stand(accel, view, view->up, tan_y / margin, through, &y, &back_y);
    const vec3 across = vec3_madd(vec3_scale(view->right, x), y, view->up);
    /* A corner blunter than the view would be where the eye is: that stays in front of everything. */
    const double front = reach(accel, vec3_neg(view->forward)), depth = front + reach(accel, view->forward);
    const double back = box3_upper(front + 0.01 * depth, box3_upper(back_x, back_y));
    return vec3_madd(across, -back, view->forward);
}

/* An orthographic camera stands in front of everything. */
static vec3 orthographic_eye(const struct accel *accel, const struct view *view, const vec3 *through) {
    const double front = reach(accel, vec3_neg(view->forward)), depth = front + reach(accel, view->forward);
    const double x = 0.5 * (reach(accel, view->right) - reach(accel, vec3_neg(view->right)));
    const double y = 0.5 * (reach(accel, view->up) - reach(accel, vec3_neg(view->up)));
    const vec3 middle = through ? *through : vec3_madd(vec3_scale(view->right, x), y, view->up);
    return vec3_madd(middle, -(front + vec3_dot(middle, view->forward) + depth), view->forward);
}

/* Half the height of an orthographic view from `eye` that holds the scene. */
static double orthographic_half(const struct accel *accel, const struct view *view, vec3 eye, double aspect) {
    const double x = vec3_dot(eye, view->right), y = vec3_dot(eye, view->up);
    const double wide = box3_upper(reach(accel, view->right) - x, reach(accel, vec3_neg(view->right)) + x);
    const double high = box3_upper(reach(accel, view->up) - y, reach(accel, vec3_neg(view->up)) + y);
    return margin * box3_upper(wide / aspect, high);
}

/* ---- The view ---- */

static vec3 view_direction(const struct camera *camera, vec3 middle) {
    if (camera->has_direction) return camera->direction;
    if (!camera->has_eye) return default_direction;
    const vec3 to_middle = vec3_sub(middle, camera->eye);
    return vec3_max_abs(to_middle) > 0.0 ? to_middle : (vec3){0, 0, -1};
}

struct view camera_view(const struct scene *scene, const struct accel *accel, uint32_t width,
                        uint32_t height) {
    const struct camera *camera = &scene->camera;
    const box3 bounds = accel_extent(accel);
    const vec3 center = box3_is_bounded(bounds) ? box3_center(bounds) : (vec3){0, 0, 0};
    const vec3 middle = camera->has_look_at ? camera->look_at : center;
    const vec3 *through = camera->has_look_at ? &middle : NULL;
    const double aspect = (double)width / (double)height;
    const double tan_y = elementary_tan_deg(0.5 * camera->fov_deg), tan_x = tan_y * aspect;
    struct view view = {.orthographic = camera->projection == CAMERA_ORTHOGRAPHIC};
    set_axes(&view, camera, view_direction(camera, middle));

    if (camera->has_eye)
        view.eye = camera->eye;
    else if (view.orthographic)
        view.eye = orthographic_eye(accel, &view, through);
    else
        view.eye = perspective_eye(accel, &view, tan_x, tan_y, through);
    view.distance = vec3_length(vec3_sub(middle, view.eye));

    const double half = !view.orthographic   ? tan_y
                        : camera->has_height ? 0.5 * camera->height
                                             : orthographic_half(accel, &view, view.eye, aspect);
    view.right = vec3_scale(view.right, half * aspect);
    view.up = vec3_scale(view.up, half);
    return view;
}
