#include "bench/report/pdf/pages.hpp"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "bench/report/pdf/verdict_sign.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::pdf {
namespace {

constexpr double page_width_pt = 595.276, page_height_pt = 841.89;  // 210 mm x 297 mm
constexpr double left_pt = (page_width_pt - body_width_pt) / 2;
constexpr double head_pt = 26, body_pt = 52, foot_pt = body_pt + body_height_pt + 10;
const TextStyle in_frame{.size_pt = 7.5, .colour = colours::faint};

// How much must fit on the page for blocks[at] to stand on it.
double together_pt(const Blocks& blocks, std::size_t at) {
  double sum_pt = 0;
  for (; at < blocks.size(); ++at) {
    sum_pt += blocks[at].height_pt;
    if (!blocks[at].keeps_next) break;
  }
  return sum_pt;
}

std::vector<Blocks> paginate(const Blocks& blocks) {
  std::vector<Blocks> pages(1);
  double used_pt = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const bool is_space = !blocks[i].draw;
    const bool fits = used_pt + blocks[i].height_pt <= body_height_pt;
    const double wanted_pt = together_pt(blocks, i);
    const bool follows = i > 0 && blocks[i - 1].keeps_next && fits;
    const bool moves = wanted_pt <= body_height_pt && used_pt + wanted_pt > body_height_pt;
    if (used_pt > 0 && !follows && !is_space && (moves || !fits)) {
      pages.emplace_back();
      used_pt = 0;
      if (blocks[i].head) {
        append(pages.back(), *blocks[i].head);
        used_pt = height_pt(*blocks[i].head);
      }
    }
    if (is_space && used_pt == 0) continue;
    pages.back().push_back(blocks[i]);
    used_pt += blocks[i].height_pt;
  }
  return pages;
}

cairo_status_t take(void* pdf, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(pdf)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void describe_in(cairo_surface_t* surface, const PageFrame& frame) {
  const auto say = [surface](cairo_pdf_metadata_t what, const std::string& text) {
    cairo_pdf_surface_set_metadata(surface, what, text.c_str());
  };
  say(CAIRO_PDF_METADATA_TITLE, frame.title);
  say(CAIRO_PDF_METADATA_CREATOR, frame.source);
  say(CAIRO_PDF_METADATA_CREATE_DATE, frame.created);
}

void draw_right(cairo_t* page, const Typesetter& typesetter, const std::string& markup,
                const TextStyle& style, double y_pt) {
  const auto lines = typesetter.lines(markup, style, body_width_pt, 1);
  lines.front().draw(page, left_pt + body_width_pt - lines.front().width_pt, y_pt);
}

void draw_frame(cairo_t* page, const Typesetter& typesetter, const PageFrame& frame,
                const std::string& number) {
  constexpr double sign_pt = 9, beside_pt = 90;
  const auto unit =
      typesetter.lines(xml_escaped(frame.unit), in_frame, body_width_pt - beside_pt, 1);
  unit.front().draw(page, left_pt, head_pt);
  const TextStyle loud{.size_pt = 9, .bold = true, .colour = colour_of(frame.outcome)};
  const std::string word = to_string(frame.outcome);
  draw_right(page, typesetter, word, loud, head_pt - 1.5);
  const double word_pt = typesetter.width_pt(word, loud);
  draw_sign(page, frame.outcome, left_pt + body_width_pt - word_pt - sign_pt - 4, head_pt - 0.5,
            sign_pt);
  fill_box(page, colours::line, left_pt, head_pt + 14, body_width_pt, 0.7);
  const auto source =
      typesetter.lines(xml_escaped(frame.source), in_frame, body_width_pt - beside_pt, 1);
  source.front().draw(page, left_pt, foot_pt);
  draw_right(page, typesetter, number, in_frame, foot_pt);
}

}  // namespace

std::string make_pages(const Typesetter& typesetter, const std::vector<Blocks>& parts,
                       const PageFrame& frame) {
  std::vector<Blocks> pages;
  for (const Blocks& part : parts) {
    if (part.empty()) continue;
    for (Blocks& page : paginate(part)) pages.push_back(std::move(page));
  }
  std::string pdf;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(take, &pdf, page_width_pt, page_height_pt),
      cairo_surface_destroy);
  describe_in(surface.get(), frame);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(surface.get()),
                                                                cairo_destroy);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    draw_frame(page.get(), typesetter, frame, fmt::format("page {} of {}", i + 1, pages.size()));
    draw_all(pages[i], page.get(), left_pt, body_pt);
    cairo_show_page(page.get());
  }
  cairo_surface_finish(surface.get());
  if (const auto status = cairo_status(page.get()); status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("make_pages: ") + cairo_status_to_string(status));
  }
  return pdf;
}

}  // namespace rvbench::bench::pdf
